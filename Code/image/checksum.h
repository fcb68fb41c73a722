// The two checksums of PNG: CRC-32 of a chunk (ISO 3309) and Adler-32 of a zlib stream (RFC 1950).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// The checksum of data that comes in parts: pass the result of the part before.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);
std::uint32_t adler32(std::span<const std::uint8_t> bytes, std::uint32_t before = 1);
// Of two parts from the checksum of each and the size of the second.
std::uint32_t adler32Joined(std::uint32_t first, std::uint32_t second, std::size_t secondSize);
