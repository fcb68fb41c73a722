#include "image/run_codes.h"

#include "image/huffman.h"

#include <algorithm>
#include <utility>

// Counts in turns, so that a count needn't wait for the one before it.
struct RunCounts::Turn {
    std::array<std::uint32_t, 256> bytes{};
    std::array<std::uint32_t, kSizes> gaps{};
    std::uint32_t longestMatches = 0;

    void addGap(std::size_t zeros) {
        const std::size_t first = withoutLongestMatches(zeros);
        if (zeros != first)
            longestMatches += static_cast<std::uint32_t>((zeros - first) / kLongestMatch);
        ++gaps[first];
    }
};

void RunCounts::add(std::span<const std::uint8_t> bytes, std::size_t begin,
                    std::span<const std::uint32_t> places, std::size_t end) {
    constexpr std::size_t kTurns = 2;
    std::array<Turn, kTurns> turns;
    std::size_t next = begin; // behind the byte before
    const auto count = [&](Turn& turn, std::size_t place) {
        turn.addGap(place - next);
        ++turn.bytes[bytes[place]];
        next = place + 1;
    };
    std::size_t i = 0;
    for (; i + kTurns <= places.size(); i += kTurns)
        for (std::size_t k = 0; k < kTurns; ++k) count(turns[k], places[i + k]);
    for (; i < places.size(); ++i) count(turns[0], places[i]);
    turns[0].addGap(end - next);
    for (const Turn& turn : turns) add(turn);
}

void RunCounts::add(const Turn& turn) {
    for (std::size_t b = 0; b < bytes_.size(); ++b) bytes_[b] += turn.bytes[b];
    for (std::size_t zeros = 0; zeros < kSizes; ++zeros) gaps_[zeros] += turn.gaps[zeros];
    longestMatches_ += turn.longestMatches;
}

SymbolCounts RunCounts::symbols() const {
    SymbolCounts symbols;
    std::copy(bytes_.begin(), bytes_.end(), symbols.literals.begin());
    symbols.literals[kEndOfBlock] = 1;
    symbols.literals[lengthSymbol(kLongestMatch)] += longestMatches_;
    symbols.distances[0] += longestMatches_;
    for (std::size_t zeros = 1; zeros < kSizes; ++zeros) {
        const std::uint32_t count = gaps_[zeros];
        symbols.literals[0] +=
            haveMatch_[zeros] ? count : count * static_cast<std::uint32_t>(zeros);
        if (!haveMatch_[zeros]) continue;
        symbols.literals[lengthSymbol(zeros - 1)] += count;
        symbols.distances[0] += count;
    }
    return symbols;
}

void RunCounts::choose() {
    constexpr unsigned kUnknown = 12; // bits of symbols that nothing used
    constexpr unsigned kBefore = 1;   // of the only distance
    const std::vector<std::uint8_t> lengths = huffmanLengths(symbols().literals, kMaxCodeLength);
    for (std::size_t zeros = 1 + kShortestMatch; zeros < kSizes; ++zeros) {
        const unsigned known = lengths[lengthSymbol(zeros - 1)];
        const unsigned match =
            (known != 0 ? known : kUnknown) + kLengthRanges[kLengthSlot[zeros - 1]].extra + kBefore;
        haveMatch_[zeros] = match < (zeros - 1) * lengths[0];
    }
}

RunCodes::RunCodes(const RunCounts& counts)
    : codes_(counts.symbols()), bits_(codes_.bits(counts.symbols())), bytes_(codes_) {
    for (std::size_t zeros = 1; zeros < RunCounts::kSizes; ++zeros)
        if (counts.haveMatch(zeros))
            gaps_[zeros] = bytes_.zeroAndMatch(zeros);
        else if (zeros * bytes_[0].length <= kMostBits)
            gaps_[zeros] = bytes_.zeros(zeros);
        else
            fit_ &= !counts.occur(zeros);
}

void RunCodes::put(BitWriter& out, std::span<const std::uint8_t> bytes,
                   std::span<const std::uint32_t> places, bool last) const {
    out.reserveBits(bits_ + 64);
    codes_.putHeader(out, last);
    BitWriter writer = std::move(out);            // in registers: nothing written can be part of it
    const HuffmanCode* const ofByte = &bytes_[0]; // as what is written may be anything
    std::size_t next = 0;                         // behind the byte before
    for (const std::uint32_t place : places) {
        JoinedCodes codes = gapBefore(writer, place - next);
        codes.add(ofByte[bytes[place]]);
        writer.put(codes);
        writer.flush();
        next = place + 1;
    }
    writer.put(gapBefore(writer, bytes.size() - next));
    writer.put(bytes_.endOfBlock());
    writer.flush();
    out = std::move(writer);
}

inline JoinedCodes RunCodes::gapBefore(BitWriter& out, std::size_t zeros) const {
    if (zeros < RunCounts::kSizes) [[likely]]
        return gaps_[zeros];
    const std::size_t first = withoutLongestMatches(zeros);
    out.put(gaps_[first]);
    out.flush();
    bytes_.putLongestMatches(out, zeros - first);
    return {};
}
