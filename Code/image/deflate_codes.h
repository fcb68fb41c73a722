// The numbers of RFC 1951 that reading and writing share: extra bits of lengths and distances.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

constexpr std::size_t kLiteralCodes = 286, kDistanceCodes = 30, kEndOfBlock = 256;
constexpr int kMaxCodeLength = 15;
constexpr std::size_t kShortestMatch = 3, kLongestMatch = 258, kWindow = 32768;

// Symbol 257 + i stands for a match of base to base + 2^extra - 1 bytes; distances likewise.
struct CodeRange {
    std::uint16_t base;
    std::uint8_t extra;
};
constexpr std::array<CodeRange, 29> kLengthRanges{
    {{3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
     {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
     {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}}};
constexpr auto kLengthSlot = [] { // by length: which of them
    std::array<std::uint8_t, kLongestMatch + 1> slot{};
    for (std::size_t s = 0; s < kLengthRanges.size(); ++s)
        for (std::size_t i = kLengthRanges[s].base; i < slot.size(); ++i)
            slot[i] = static_cast<std::uint8_t>(s);
    return slot;
}();
constexpr std::size_t lengthSymbol(std::size_t length) {
    return kEndOfBlock + 1 + kLengthSlot[length];
}
// What is left of a run of one byte when longest matches are taken from its end: something, if it
// is not empty.
constexpr std::size_t withoutLongestMatches(std::size_t run) {
    return run <= kLongestMatch ? run : (run - 1) % kLongestMatch + 1;
}
constexpr auto kDistanceRanges = [] {
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
constexpr auto kFixedLiteralLengths = [] {
    std::array<std::uint8_t, 288> lengths{};
    for (std::size_t i = 0; i < 288; ++i) lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    return lengths;
}();
