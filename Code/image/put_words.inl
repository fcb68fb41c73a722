// Writes words with their codes: byte_lanes.h says what.

void putWords(BitWriter& out, const WordList& words, const WordCodes& codes) {
    static_assert(7 + 4 * WordCodes::kLongest < 64);
    BitWriter writer = std::move(out); // in registers: nothing written can be part of it
    const auto put = [&writer](const JoinedCodes& some) {
        writer.put(some);
        writer.flush();
    };
    const HuffmanCode* const ofByte = &codes.ofBytes()[0]; // as what is written may be anything
    const auto ofTwo = [ofByte](const std::uint8_t* bytes) {
        const HuffmanCode a = ofByte[bytes[0]], b = ofByte[bytes[1]];
        return JoinedCodes{a.bits | std::uint64_t{b.bits} << a.length,
                           unsigned{a.length} + b.length};
    };
    const auto ofFour = [ofTwo](const std::uint8_t* bytes) {
        const JoinedCodes a = ofTwo(bytes), b = ofTwo(bytes + 2);
        return JoinedCodes{a.bits | b.bits << a.length, a.length + b.length};
    };
    for (std::size_t i = 0; i < words.count(); ++i) {
        const std::size_t zeroWords = words.zeroWordsBefore(i);
        if (!WordCodes::areMany(zeroWords)) [[likely]] {
            put(codes.ofZeroWords(zeroWords));
        } else {
            out = std::move(writer);
            codes.putZeroWords(out, zeroWords);
            writer = std::move(out);
        }
        const std::uint8_t* const word = words.bytes().data() + kWordBytes * i;
        put(ofFour(word));
        put(ofFour(word + 4));
    }
    out = std::move(writer);
}
