// Unpacks zlib streams. Knows nothing about PNG.
#include "base/text.h"
#include "image/bits.h"
#include "image/deflate_codes.h"
#include "image/formats.h"
#include "image/zlib.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace {

[[noreturn]] void broken(const std::string& name, const std::string& what) {
    failPicture(name, cat("broken compressed data: ", what, "; the file is damaged"));
}

// Bits from the lowest of each byte upwards.
class BitReader {
public:
    BitReader(std::span<const std::uint8_t> bytes, const std::string& name)
        : bytes_(bytes), name_(&name) {}

    // Afterwards at least 48 bits wait, or all that are left.
    void refill() {
        if (position_ + 8 <= bytes_.size()) {
            waiting_ |= loadLittle<std::uint64_t>(bytes_.data() + position_) << count_;
            position_ += (63 - count_) >> 3;
            count_ |= 56;
        } else {
            while (count_ <= 48 && position_ < bytes_.size()) {
                waiting_ |= static_cast<std::uint64_t>(bytes_[position_++]) << count_;
                count_ += 8;
            }
        }
    }
    // The next bits without consuming them; zeros behind the end.
    std::uint32_t peek(unsigned n) const {
        return static_cast<std::uint32_t>(waiting_ & ((std::uint64_t{1} << n) - 1));
    }
    void consume(unsigned n) {
        if (n > count_) broken(*name_, "the file ends in the middle of it");
        waiting_ >>= n;
        count_ -= n;
    }
    std::uint32_t take(unsigned n) { // after refill(); at most 16 bits each
        const std::uint32_t bits = peek(n);
        consume(n);
        return bits;
    }
    // Drops the rest of the current byte and hands out the bytes from there.
    std::span<const std::uint8_t> restFromByte() const {
        return bytes_.subspan(position_ - count_ / 8);
    }
    void continueAt(std::span<const std::uint8_t> rest) {
        position_ = bytes_.size() - rest.size();
        waiting_ = 0;
        count_ = 0;
    }

private:
    std::span<const std::uint8_t> bytes_;
    const std::string* name_;
    std::size_t position_ = 0;
    std::uint64_t waiting_ = 0; // bits above count_ are those of later bytes, or zero
    unsigned count_ = 0;
};

// A canonical Huffman code: codes up to kFastBits by one table look-up, longer ones bit by bit.
class HuffmanDecoder {
public:
    // Fails when the lengths are no prefix code. A code with one symbol of length 1 is allowed (RFC
    // 1951, 3.2.7), and one without symbols until something is to be decoded.
    HuffmanDecoder(std::span<const std::uint8_t> lengths, const std::string& name,
                   const char* what) {
        for (const std::uint8_t length : lengths) ++count_[length];
        count_[0] = 0;
        int left = 1, used = 0;
        std::array<std::uint16_t, kMaxCodeLength + 2> offset{};
        std::array<std::uint32_t, kMaxCodeLength + 2> code{};
        for (std::size_t n = 1; n <= kMaxCodeLength; ++n) {
            left = 2 * left - count_[n];
            if (left < 0) broken(name, cat("the ", what, " code has too many codes"));
            used += count_[n];
            offset[n + 1] = static_cast<std::uint16_t>(offset[n] + count_[n]);
            code[n + 1] = (code[n] + count_[n]) << 1;
        }
        if (left > 0 && !(used == 0 || (used == 1 && count_[1] == 1)))
            broken(name, cat("the ", what, " code leaves codes unused"));
        for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
            const std::size_t n = lengths[symbol];
            if (n == 0) continue;
            symbols_[offset[n]++] = static_cast<std::uint16_t>(symbol);
            const std::uint32_t own = code[n]++;
            if (n > kFastBits) continue;
            std::uint32_t reversed = 0; // codes are stored from their highest bit
            for (std::size_t i = 0; i < n; ++i) reversed |= (own >> i & 1) << (n - 1 - i);
            for (std::size_t i = reversed; i < fast_.size(); i += std::size_t{1} << n)
                fast_[i] = static_cast<std::uint16_t>(symbol << 4 | n);
        }
    }

    std::size_t decode(BitReader& bits, const std::string& name) const {
        const std::uint16_t entry = fast_[bits.peek(kFastBits)];
        if (entry != 0) {
            bits.consume(entry & 15);
            return entry >> 4;
        }
        const std::uint32_t waiting = bits.peek(kMaxCodeLength);
        std::uint32_t code = 0, first = 0, index = 0;
        for (unsigned n = 1; n <= kMaxCodeLength; ++n) {
            code |= waiting >> (n - 1) & 1;
            const std::uint32_t count = count_[n];
            if (code - first < count) {
                bits.consume(n);
                return symbols_[index + code - first];
            }
            index += count;
            first = (first + count) << 1;
            code <<= 1;
        }
        bits.consume(kMaxCodeLength); // names the end of the file if that is the reason
        broken(name, "a code that stands for nothing");
    }

private:
    static constexpr unsigned kFastBits = 11;
    std::array<std::uint16_t, 1 << kFastBits> fast_{}; // symbol << 4 | length; 0: not here
    std::array<std::uint16_t, kMaxCodeLength + 1> count_{};
    std::array<std::uint16_t, 288> symbols_{};
};

class Inflater {
public:
    Inflater(std::span<const std::uint8_t> bytes, std::size_t size, const std::string& name)
        : bits_(bytes, name), out_(size), name_(name) {}

    void run() {
        bool last = false;
        while (!last) {
            bits_.refill();
            last = bits_.take(1) != 0;
            switch (bits_.take(2)) {
            case 0: storedBlock(); break;
            case 1: fixedBlock(); break;
            case 2: dynamicBlock(); break;
            default: broken(name_, "a block of unknown kind");
            }
        }
        if (used_ != out_.size())
            broken(name_, cat("it unpacks to ", used_, " bytes instead of ", out_.size()));
    }
    std::span<const std::uint8_t> rest() const { return bits_.restFromByte(); }
    std::vector<std::uint8_t> result() && { return std::move(out_); }

private:
    void checkRoom(std::span<const std::uint8_t> out, std::size_t used, std::size_t count) const {
        if (count > out.size() - used)
            broken(name_, cat("it unpacks to more than ", out.size(), " bytes"));
    }

    void storedBlock() {
        auto rest = bits_.restFromByte();
        if (rest.size() < 4) broken(name_, "the file ends in the middle of it");
        const std::size_t length = loadLittle<std::uint16_t>(&rest[0]);
        if ((length ^ 0xFFFF) != loadLittle<std::uint16_t>(&rest[2]))
            broken(name_, "a stored block contradicts its length");
        rest = rest.subspan(4);
        if (length > rest.size()) broken(name_, "the file ends in the middle of it");
        checkRoom(out_, used_, length);
        std::copy_n(rest.begin(), length, out_.begin() + static_cast<std::ptrdiff_t>(used_));
        used_ += length;
        bits_.continueAt(rest.subspan(length));
    }

    void fixedBlock() {
        std::array<std::uint8_t, 32> fives{}; // the two that stand for nothing make it complete
        fives.fill(5);
        block({kFixedLiteralLengths, name_, "literal"}, {fives, name_, "distance"});
    }

    void dynamicBlock() {
        bits_.refill();
        const std::size_t literalCount = bits_.take(5) + 257, distanceCount = bits_.take(5) + 1;
        const std::size_t lengthCount = bits_.take(4) + 4;
        if (literalCount > kLiteralCodes || distanceCount > kDistanceCodes)
            broken(name_, "more codes than there are");
        std::array<std::uint8_t, 19> lengthLengths{};
        for (std::size_t i = 0; i < lengthCount; ++i) {
            bits_.refill();
            lengthLengths[kCodeLengthOrder[i]] = static_cast<std::uint8_t>(bits_.take(3));
        }
        const HuffmanDecoder lengthDecoder(lengthLengths, name_, "code-length");
        std::array<std::uint8_t, kLiteralCodes + kDistanceCodes> lengths{};
        const std::size_t count = literalCount + distanceCount;
        for (std::size_t i = 0; i < count;) {
            bits_.refill();
            const std::size_t symbol = lengthDecoder.decode(bits_, name_);
            if (symbol < 16) {
                lengths[i++] = static_cast<std::uint8_t>(symbol);
                continue;
            }
            if (symbol == 16 && i == 0) broken(name_, "a repeated code length without a first");
            const std::uint8_t repeated = symbol == 16 ? lengths[i - 1] : std::uint8_t{0};
            const std::size_t times = symbol == 16   ? 3 + bits_.take(2)
                                      : symbol == 17 ? 3 + bits_.take(3)
                                                     : 11 + bits_.take(7);
            if (times > count - i) broken(name_, "more code lengths than promised");
            std::fill_n(lengths.begin() + static_cast<std::ptrdiff_t>(i), times, repeated);
            i += times;
        }
        if (lengths[kEndOfBlock] == 0) broken(name_, "a block without an end");
        const std::span<const std::uint8_t> all(lengths);
        const HuffmanDecoder literals(all.first(literalCount), name_, "literal");
        block(literals, {all.subspan(literalCount, distanceCount), name_, "distance"});
    }

    void block(const HuffmanDecoder& literals, const HuffmanDecoder& distances) {
        // In variables of its own: for the compiler, any byte of out_ may be one of a member.
        BitReader bits = bits_;
        const std::span<std::uint8_t> out = out_;
        std::size_t used = used_;
        while (true) {
            bits.refill(); // 48 bits: three literals (15 each)
            std::size_t symbol = literals.decode(bits, name_);
            for (int i = 0; i < 2 && symbol < kEndOfBlock; ++i) {
                putLiteral(out, used, symbol);
                symbol = literals.decode(bits, name_);
            }
            if (symbol < kEndOfBlock) {
                putLiteral(out, used, symbol);
                continue;
            }
            if (symbol == kEndOfBlock) break;
            if (symbol >= kLiteralCodes) broken(name_, "an unknown match length");
            bits.refill(); // the rest of a length (5) and a distance (15 + 13)
            const CodeRange lengthRange = kLengthRanges[symbol - kEndOfBlock - 1];
            const std::size_t length = lengthRange.base + bits.take(lengthRange.extra);
            const std::size_t distanceSymbol = distances.decode(bits, name_);
            if (distanceSymbol >= kDistanceCodes) broken(name_, "an unknown distance");
            const CodeRange distanceRange = kDistanceRanges[distanceSymbol];
            const std::size_t distance = distanceRange.base + bits.take(distanceRange.extra);
            if (distance > used) broken(name_, "a distance that reaches before the start");
            checkRoom(out, used, length);
            copyMatch(out, used, length, distance);
            used += length;
        }
        bits_ = bits;
        used_ = used;
    }
    void putLiteral(std::span<std::uint8_t> out, std::size_t& used, std::size_t symbol) const {
        checkRoom(out, used, 1);
        out[used++] = static_cast<std::uint8_t>(symbol);
    }

    // The copied bytes may overlap their source: then they repeat.
    static void copyMatch(std::span<std::uint8_t> out, std::size_t used, std::size_t length,
                          std::size_t distance) {
        std::uint8_t* const to = out.data() + used;
        const std::uint8_t* const from = to - distance;
        constexpr std::size_t kWord = 8, kLong = 64;
        // Most are short: in words, which may write behind the end what comes later.
        if (distance >= kWord && length <= kLong && out.size() - used >= length + kWord)
            for (std::size_t i = 0; i < length; i += kWord) std::memcpy(to + i, from + i, kWord);
        else if (distance >= length)
            std::memcpy(to, from, length);
        else if (distance == 1)
            std::memset(to, *from, length);
        else
            for (std::size_t i = 0; i < length; ++i) to[i] = from[i];
    }

    BitReader bits_;
    std::vector<std::uint8_t> out_;
    std::size_t used_ = 0;
    const std::string& name_;
};

} // namespace

std::vector<std::uint8_t> inflateZlib(std::span<const std::uint8_t> stream, std::size_t size,
                                      const std::string& name) {
    if (stream.size() < 6) broken(name, "the file ends in the middle of it");
    const unsigned method = stream[0], flags = stream[1];
    if ((method & 15) != 8 || method >> 4 > 7 || (method << 8 | flags) % 31 != 0)
        broken(name, "it does not start as a zlib stream");
    if (flags & 32) broken(name, "it wants a preset dictionary, which no picture has");
    Inflater inflater(stream.subspan(2), size, name);
    inflater.run();
    const auto rest = inflater.rest();
    if (rest.size() < 4) broken(name, "the file ends in the middle of it");
    const auto promised = loadBig<std::uint32_t>(rest.data());
    std::vector<std::uint8_t> bytes = std::move(inflater).result();
    if (adler32(bytes) != promised) broken(name, "its checksum (Adler-32) does not fit");
    return bytes;
}
