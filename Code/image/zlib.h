// zlib streams (RFC 1950 and 1951): packed, unpacked, and the checksums that go with them. Knows
// nothing about PNG but its checksum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

// CRC-32 of a PNG chunk (ISO 3309) and Adler-32 of a zlib stream. Of data that comes in parts: pass
// the result of the part before.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);
std::uint32_t adler32(std::span<const std::uint8_t> bytes, std::uint32_t before = 1);
// Of two parts from the checksum of each and the size of the second.
std::uint32_t adler32Joined(std::uint32_t first, std::uint32_t second, std::size_t secondSize);

// Two ways to pack bytes.
enum class Packing {
    Runs,    // single bytes and runs of one byte
    Matches, // and whatever comes again within 32 KB: takes two to three times as long
};
// Matches where they make a sample of the bytes 5 % smaller. In most rendered pictures, once their
// rows are filtered, they don't: 3 % of a file on average (Output/*.ppm).
Packing choosePacking(std::span<const std::uint8_t> bytes);

// A stream is made in pieces, which may be packed at the same time: the header, the pieces, which
// know nothing of each other, the `last` one marked, and the end with the checksum of all bytes.
inline constexpr std::array<std::uint8_t, 2> kZlibHeader{0x78, 0x5E}; // window 32 K, fast
// The same bytes, at most 2^32 - 2^16, give the same piece everywhere. It comes behind what is in
// `before`, in its memory.
std::vector<std::uint8_t> deflatePiece(std::span<const std::uint8_t> bytes, bool last,
                                       Packing packing, std::vector<std::uint8_t> before = {});
constexpr std::array<std::uint8_t, 4> zlibEnd(std::uint32_t adler) {
    return {static_cast<std::uint8_t>(adler >> 24), static_cast<std::uint8_t>(adler >> 16),
            static_cast<std::uint8_t>(adler >> 8), static_cast<std::uint8_t>(adler)};
}

// One byte of a deflate stream can stand for at most this many bytes (a match of 258 in two bits).
inline constexpr std::size_t kMaxInflation = 1032;
// The unpacked bytes, exactly `size` of them; bytes after the stream are ignored. The caller checks
// `size` against kMaxInflation before: it is allocated at once. Fails (ErrorKind::Input) with
// `name` when the stream is broken, too short, too long or fails its checksum.
std::vector<std::uint8_t> inflateZlib(std::span<const std::uint8_t> stream, std::size_t size,
                                      const std::string& name);
