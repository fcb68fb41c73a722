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

WordCodes::WordCodes(const DynamicCodes& codes) : bytes_(codes) {
    for (std::size_t words = 0; words < kGaps; ++words)
        gaps_[words] = zerosCode(kWordBytes * words);
}

JoinedCodes WordCodes::zerosCode(std::size_t zeros) const {
    static_assert(2 * kLongest + 5 + 1 <= 56 && kShortestMatch * kLongest <= 56);
    return zeros > kShortestMatch ? bytes_.zeroAndMatch(zeros) : bytes_.zeros(zeros);
}

void WordCodes::putZeros(BitWriter& out, std::size_t zeros) const {
    const std::size_t first = withoutLongestMatches(zeros);
    out.put(zerosCode(first));
    out.flush();
    bytes_.putLongestMatches(out, zeros - first);
}

void WordCodes::putEnd(BitWriter& out, std::size_t zeroWords,
                       std::span<const std::uint8_t> rest) const {
    out.makeRoom(mostBits(2, zeroWords)); // one is the rest with the end
    putZeros(out, kWordBytes * zeroWords);
    for (const std::uint8_t byte : rest) {
        out.put(bytes_[byte]);
        out.flush();
    }
    out.put(bytes_.endOfBlock());
    out.flush();
}

std::size_t WordCodes::mostBits(std::size_t gaps, std::size_t zeroWords) {
    constexpr std::size_t kOfGap = 2 * kLongest + 5 + 1, kOfMatch = kLongest + 1;
    return gaps * (kOfGap + kWordBytes * kLongest) +
           kWordBytes * zeroWords / kLongestMatch * kOfMatch;
}
