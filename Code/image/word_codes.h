// Words of eight bytes, and what is written of them: the codes of a run of words that are zero, and
// those of each byte of the word behind it.
// Private to image/.
#pragma once

#include "image/bit_writer.h"
#include "image/byte_codes.h"
#include "image/byte_counts.h"
#include "image/deflate_codes.h"
#include "image/dynamic_codes.h"

#include <array>
#include <cstdint>
#include <span>

inline constexpr std::size_t kWordBytes = 8;

// The words of a piece that aren't zero, one behind the other, and how many that are zero come
// before each.
class WordList {
public:
    static constexpr std::size_t kMost = 512;

    // All of them: whole words, kMost or fewer, behind so many that are zero.
    void find(std::span<const std::uint8_t> piece, std::size_t zeroWordsBefore);

    std::size_t count() const { return count_; }
    std::size_t zeroWordsBefore(std::size_t i) const { return behind_[i + 1] - behind_[i] - 1; }
    std::size_t zeroWordsBehind() const { return end_ - behind_[count_]; }
    std::span<const std::uint8_t> bytes() const {
        return std::span(bytes_).first(kWordBytes * count_);
    }

private:
    // Places from the first zero before the piece on; behind the word before.
    std::size_t count_ = 0, end_ = 0;
    std::array<std::uint32_t, kMost + 1> behind_;
    std::array<std::uint8_t, kMost * kWordBytes> bytes_;
};

// What a sample of words consists of.
class WordCounts {
public:
    void add(const WordList& words);
    // With an end, and once whatever other words may need.
    SymbolCounts symbols() const;

private:
    void addGap(std::size_t zeros);

    ByteCounts bytes_;
    std::array<std::uint32_t, kLongestMatch + 1> gaps_{}; // by zeros, less longest matches
    std::uint32_t longestMatches_ = 0;
};

class WordCodes {
public:
    static constexpr std::size_t kLongest = 14; // bits: four codes fit between flushes

    explicit WordCodes(const DynamicCodes& codes);

    const ByteCodes& ofBytes() const { return bytes_; }
    // Of words that are zero, maybe none. Of many there isn't one.
    static constexpr bool areMany(std::size_t zeroWords) { return zeroWords >= kGaps; }
    const JoinedCodes& ofZeroWords(std::size_t count) const { return gaps_[count]; }
    void putZeroWords(BitWriter& out, std::size_t count) const {
        putZeros(out, kWordBytes * count);
    }

    // So many words that are zero, the bytes behind them, and the end of the block. Makes room.
    void putEnd(BitWriter& out, std::size_t zeroWords, std::span<const std::uint8_t> rest) const;
    // Of a piece behind so many words that are zero, up to its last word that isn't.
    static std::size_t mostBits(const WordList& words, std::size_t zeroWordsBefore) {
        return mostBits(words.count(), zeroWordsBefore + WordList::kMost);
    }

private:
    static constexpr std::size_t kGaps = kLongestMatch / kWordBytes + 1;

    // Of gaps so many, in which there are so many words, and the words behind them.
    static std::size_t mostBits(std::size_t gaps, std::size_t zeroWords);
    JoinedCodes zerosCode(std::size_t zeros) const; // up to the longest match
    void putZeros(BitWriter& out, std::size_t zeros) const;

    ByteCodes bytes_;
    std::array<JoinedCodes, kGaps> gaps_; // by words; the first is no gap and has no code
};
