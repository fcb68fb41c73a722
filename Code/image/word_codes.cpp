#include "image/word_codes.h"

#include <algorithm>
#include <cstring>

void WordList::find(std::span<const std::uint8_t> piece, std::size_t zeroWordsBefore) {
    std::size_t count = 0; // without branches, which would be guessed wrong
    auto place = static_cast<std::uint32_t>(zeroWordsBefore);
    behind_[0] = 0;
    for (std::size_t at = 0; at < piece.size(); at += kWordBytes) {
        std::uint64_t word;
        std::memcpy(&word, &piece[at], kWordBytes);
        std::memcpy(&bytes_[kWordBytes * count], &word, kWordBytes);
        behind_[count + 1] = ++place;
        count += word != 0;
    }
    count_ = count;
    end_ = place;
}

void WordCounts::add(const WordList& words) {
    bytes_.add(words.bytes());
    for (std::size_t i = 0; i < words.count(); ++i) addGap(kWordBytes * words.zeroWordsBefore(i));
    addGap(kWordBytes * words.zeroWordsBehind());
}
void WordCounts::addGap(std::size_t zeros) {
    const std::size_t first = withoutLongestMatches(zeros);
    longestMatches_ += static_cast<std::uint32_t>((zeros - first) / kLongestMatch);
    ++gaps_[first];
}

SymbolCounts WordCounts::symbols() const {
    SymbolCounts symbols;
    symbols.literals.fill(1);
    symbols.distances[0] = 1;
    const auto sums = bytes_.sums();
    for (std::size_t b = 0; b < sums.size(); ++b) symbols.literals[b] += sums[b];
    const auto addMatches = [&symbols](std::size_t length, std::uint32_t count) {
        symbols.literals[lengthSymbol(length)] += count;
        symbols.distances[0] += count;
    };
    addMatches(kLongestMatch, longestMatches_);
    for (std::size_t zeros = kShortestMatch + 1; zeros < gaps_.size(); ++zeros) {
        symbols.literals[0] += gaps_[zeros];
        addMatches(zeros - 1, gaps_[zeros]);
    }
    return symbols;
}

WordCodes::WordCodes(const DynamicCodes& codes)
    : literals_(canonicalCodes(codes.literalLengths())),
      before_(canonicalCodes(codes.distanceLengths())[0]) {
    for (std::size_t words = 0; words < kGaps; ++words)
        gaps_[words] = zerosCode(kWordBytes * words);
}

// A zero, and a match with it or, where they are too few, more zeros.
WordCodes::Code WordCodes::zerosCode(std::size_t zeros) const {
    static_assert(2 * kLongest + 5 + 1 <= 56 && kShortestMatch * kLongest <= 56);
    Code code;
    const auto add = [&](std::uint64_t bits, unsigned length) {
        code.bits |= bits << code.length;
        code.length += length;
    };
    const bool isMatch = zeros > kShortestMatch;
    for (std::size_t i = 0; i < (isMatch ? 1 : zeros); ++i)
        add(literals_[0].bits, literals_[0].length);
    if (!isMatch) return code;
    const HuffmanCode length = literals_[lengthSymbol(zeros - 1)];
    const CodeRange range = kLengthRanges[kLengthSlot[zeros - 1]];
    add(length.bits, length.length);
    add(zeros - 1 - range.base, range.extra);
    add(before_.bits, before_.length);
    return code;
}

void WordCodes::putZeros(BitWriter& out, std::size_t zeros) const {
    const std::size_t first = withoutLongestMatches(zeros);
    const Code code = zerosCode(first);
    out.put(code.bits, code.length);
    out.flush();
    for (std::size_t left = zeros - first; left > 0; left -= kLongestMatch) {
        out.put(literals_[lengthSymbol(kLongestMatch)]);
        out.put(before_);
        out.flush();
    }
}

void WordCodes::putEnd(BitWriter& out, std::size_t zeroWords,
                       std::span<const std::uint8_t> rest) const {
    out.makeRoom(mostBits(2, zeroWords)); // one is the rest with the end
    putZeros(out, kWordBytes * zeroWords);
    for (const std::uint8_t byte : rest) {
        out.put(literals_[byte]);
        out.flush();
    }
    out.put(literals_[kEndOfBlock]);
    out.flush();
}

std::size_t WordCodes::mostBits(std::size_t gaps, std::size_t zeroWords) {
    constexpr std::size_t kOfGap = 2 * kLongest + 5 + 1, kOfMatch = kLongest + 1;
    return gaps * (kOfGap + kWordBytes * kLongest) +
           kWordBytes * zeroWords / kLongestMatch * kOfMatch;
}
