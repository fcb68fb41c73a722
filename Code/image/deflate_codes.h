// The codes of RFC 1951: the numbers that reading and writing share, Huffman codes for counts of
// symbols, and the header of a block that has codes of its own.
// Private to image/.
#pragma once

#include "image/bits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

inline constexpr std::size_t kLiteralCodes = 286, kDistanceCodes = 30, kEndOfBlock = 256;
inline constexpr int kMaxCodeLength = 15;
inline constexpr std::size_t kShortestMatch = 3, kLongestMatch = 258, kWindow = 32768;

// Symbol 257 + i stands for a match of base to base + 2^extra - 1 bytes; distances likewise.
struct CodeRange {
    std::uint16_t base;
    std::uint8_t extra;
};
constexpr std::array<CodeRange, 29> kLengthRanges{
    {{3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
     {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
     {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}}};
inline constexpr auto kLengthSlot = [] { // by length: which of them
    std::array<std::uint8_t, kLongestMatch + 1> slot{};
    for (std::size_t s = 0; s < kLengthRanges.size(); ++s)
        for (std::size_t i = kLengthRanges[s].base; i < slot.size(); ++i)
            slot[i] = static_cast<std::uint8_t>(s);
    return slot;
}();
constexpr std::size_t lengthSymbol(std::size_t length) {
    return kEndOfBlock + 1 + kLengthSlot[length];
}
inline constexpr auto kDistanceRanges = [] {
    std::array<CodeRange, kDistanceCodes> ranges{};
    unsigned base = 1;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const unsigned extra = i < 4 ? 0 : static_cast<unsigned>(i / 2 - 1);
        ranges[i] = {static_cast<std::uint16_t>(base), static_cast<std::uint8_t>(extra)};
        base += 1u << extra;
    }
    return ranges;
}();

// The order in which the lengths of the code-length code are stored.
constexpr std::array<std::uint8_t, 19> kCodeLengthOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                        11, 4,  12, 3, 13, 2, 14, 1, 15};

// Lengths of the fixed Huffman code for literals and match lengths (288 with two unused symbols).
inline constexpr auto kFixedLiteralLengths = [] {
    std::array<std::uint8_t, 288> lengths{};
    for (std::size_t i = 0; i < 288; ++i) lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    return lengths;
}();

// The length of each symbol's code, 0 for a symbol that never occurs, at most `longest`. At least
// two symbols get a code, because readers want complete codes: unused ones are added if necessary.
std::vector<std::uint8_t> huffmanLengths(std::span<const std::uint32_t> counts,
                                         std::size_t longest);

// The canonical codes of such lengths (section 3.2.2).
std::vector<HuffmanCode> canonicalCodes(std::span<const std::uint8_t> lengths);

// How often each symbol occurs in a block.
struct SymbolCounts {
    std::array<std::uint32_t, kLiteralCodes> literals{};
    std::array<std::uint32_t, kDistanceCodes> distances{};
};

// The bits that so many symbols take, with their extra bits.
std::uint64_t bitsOf(const SymbolCounts& counts, std::span<const std::uint8_t> literalLengths,
                     std::span<const std::uint8_t> distanceLengths);

class DynamicCodes {
public:
    // No code of a literal or a length is longer: four fit between two flushes of a BitWriter.
    static constexpr std::size_t kMostLiteralBits = 14;

    explicit DynamicCodes(const SymbolCounts& counts);

    const std::vector<std::uint8_t>& literalLengths() const { return literalLengths_; }
    const std::vector<std::uint8_t>& distanceLengths() const { return distanceLengths_; }
    // Of a block, with its header.
    std::uint64_t bits(const SymbolCounts& counts) const;
    void putHeader(BitWriter& out, bool last) const;

private:
    // How the lengths are stored: 16, 17 and 18 repeat.
    struct LengthToken {
        std::uint8_t symbol, extra, extraBits;
    };
    static std::vector<LengthToken> packed(std::span<const std::uint8_t> lengths);

    std::vector<std::uint8_t> literalLengths_, distanceLengths_, tokenLengths_;
    std::size_t literalCount_, distanceCount_, orderCount_; // that are stored
    std::vector<LengthToken> tokens_;
};
