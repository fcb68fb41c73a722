// Packs bytes as a zlib stream (RFC 1950 and 1951). Knows nothing about PNG.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

// The same bytes give the same stream everywhere. At most 2^32 - 2^16 bytes.
std::vector<std::uint8_t> deflateZlib(std::span<const std::uint8_t> bytes);
