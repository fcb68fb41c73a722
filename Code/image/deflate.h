// Packs bytes as a zlib stream (RFC 1950 and 1951). Knows nothing about PNG.
#pragma once

#include "image/packing.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

// The same bytes give the same stream everywhere. At most 2^32 - 2^16 bytes.
std::vector<std::uint8_t> deflateZlib(std::span<const std::uint8_t> bytes);

// The same in pieces, which may be packed at the same time: the header, the pieces, which know
// nothing of each other, the `last` one marked, and the end with the checksum of all bytes.
inline constexpr std::array<std::uint8_t, 2> kZlibHeader{0x78, 0x5E}; // window 32 K, fast
// The result comes behind what is in `before`, in its memory.
std::vector<std::uint8_t> deflatePiece(std::span<const std::uint8_t> bytes, bool last,
                                       std::vector<std::uint8_t> before = {});
// Packed this way whether it pays or not.
std::vector<std::uint8_t> deflatePiece(std::span<const std::uint8_t> bytes, bool last,
                                       Packing packing, std::vector<std::uint8_t> before = {});
constexpr std::array<std::uint8_t, 4> zlibEnd(std::uint32_t adler) {
    return {static_cast<std::uint8_t>(adler >> 24), static_cast<std::uint8_t>(adler >> 16),
            static_cast<std::uint8_t>(adler >> 8), static_cast<std::uint8_t>(adler)};
}
