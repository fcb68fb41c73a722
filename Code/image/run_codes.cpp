#include "image/run_codes.h"

#include <utility>

void Gaps::addTo(SymbolCounts& symbols) const {
    symbols.literals[lengthSymbol(kLongestMatch)] += longestMatches_;
    symbols.distances[0] += longestMatches_;
    for (std::size_t zeros = 1; zeros < kSizes; ++zeros) {
        const std::uint32_t count = counts_[zeros];
        symbols.literals[0] +=
            haveMatch_[zeros] ? count : count * static_cast<std::uint32_t>(zeros);
        if (!haveMatch_[zeros]) continue;
        symbols.literals[lengthSymbol(zeros - 1)] += count;
        symbols.distances[0] += count;
    }
}

void Gaps::choose(std::span<const std::uint8_t> literalLengths) {
    constexpr unsigned kUnknown = 12; // of symbols that nothing used
    constexpr unsigned kBefore = 1;   // the only distance
    for (std::size_t zeros = 1 + kShortestMatch; zeros < kSizes; ++zeros) {
        const unsigned known = literalLengths[lengthSymbol(zeros - 1)];
        const unsigned match =
            (known != 0 ? known : kUnknown) + kLengthRanges[kLengthSlot[zeros - 1]].extra + kBefore;
        haveMatch_[zeros] = match < (zeros - 1) * literalLengths[0];
    }
}

RunCodes::RunCodes(const Gaps& gaps, const SymbolCounts& counts)
    : codes_(counts), bits_(codes_.bits(counts)),
      literals_(canonicalCodes(codes_.literalLengths())),
      before_(canonicalCodes(codes_.distanceLengths())[0]) {
    for (std::size_t zeros = 1; zeros < Gaps::kSizes; ++zeros) {
        Code& code = gaps_[zeros];
        const auto add = [&](std::uint64_t bits, unsigned length) {
            if (code.length + length > kMostBits) {
                fit_ &= !gaps.occur(zeros);
                return;
            }
            code.bits |= bits << code.length;
            code.length += length;
        };
        const auto addCode = [&](HuffmanCode part) { add(part.bits, part.length); };
        const std::size_t literals = gaps.haveMatch(zeros) ? 1 : zeros;
        for (std::size_t i = 0; i < literals; ++i) addCode(literals_[0]);
        if (!gaps.haveMatch(zeros)) continue;
        const CodeRange range = kLengthRanges[kLengthSlot[zeros - 1]];
        addCode(literals_[lengthSymbol(zeros - 1)]);
        add(zeros - 1 - range.base, range.extra);
        addCode(before_);
    }
}

void RunCodes::put(BitWriter& out, std::span<const std::uint8_t> bytes,
                   std::span<const std::uint32_t> places, bool last) const {
    out.reserveBits(bits_ + 64);
    codes_.putHeader(out, last);
    BitWriter writer = std::move(out); // in registers: nothing written can be part of it
    std::size_t next = 0;              // behind the byte before
    for (const std::uint32_t place : places) {
        putGap(writer, place - next);
        writer.put(literals_[bytes[place]]);
        writer.flush();
        next = place + 1;
    }
    putGap(writer, bytes.size() - next);
    writer.put(literals_[kEndOfBlock]);
    writer.flush();
    out = std::move(writer);
}

inline void RunCodes::putGap(BitWriter& out, std::size_t zeros) const {
    const std::size_t first = Gaps::firstOf(zeros);
    out.put(gaps_[first].bits, gaps_[first].length);
    for (std::size_t left = zeros - first; left > 0; left -= kLongestMatch) {
        out.flush();
        out.put(literals_[lengthSymbol(kLongestMatch)]);
        out.put(before_);
    }
}
