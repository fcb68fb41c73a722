// The Huffman codes of a dynamic block (RFC 1951 section 3.2.7), made for symbol counts, and
// the header that stores their lengths.
// Private to image/.
#pragma once

#include "image/bit_writer.h"
#include "image/deflate_codes.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

struct SymbolCounts {
    std::array<std::uint32_t, kLiteralCodes> literals{};
    std::array<std::uint32_t, kDistanceCodes> distances{};
};

// The bits that so many symbols take, with their extra bits.
std::uint64_t bitsOf(const SymbolCounts& counts, std::span<const std::uint8_t> literalLengths,
                     std::span<const std::uint8_t> distanceLengths);

class DynamicCodes {
public:
    // Of literals and lengths, no code takes more bits than `longest`.
    explicit DynamicCodes(const SymbolCounts& counts, std::size_t longest = kMaxCodeLength);

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
