// Huffman code lengths for given symbol counts, and the canonical codes for lengths (RFC 1951).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The length of each symbol's code, 0 for a symbol that never occurs, at most `longest`. At least
// two symbols get a code, because readers want complete codes: unused ones are added if necessary.
std::vector<std::uint8_t> huffmanLengths(std::span<const std::uint32_t> counts,
                                         std::size_t longest);

// A code as it goes into the stream: its first bit is the lowest.
struct HuffmanCode {
    std::uint16_t bits = 0;
    std::uint8_t length = 0;
};

// Some of them, one behind the other, up to 64 bits.
struct JoinedCodes {
    std::uint64_t bits = 0;
    unsigned length = 0;

    void add(std::uint64_t more, unsigned count) {
        bits |= more << length;
        length += count;
    }
    void add(HuffmanCode code) { add(code.bits, code.length); }
};

std::vector<HuffmanCode> canonicalCodes(std::span<const std::uint8_t> lengths);
