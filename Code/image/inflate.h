// Unpacks a zlib stream (RFC 1950 and 1951). Knows nothing about PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

// One byte of a deflate stream can stand for at most this many bytes (a match of 258 in two bits).
constexpr std::size_t kMaxInflation = 1032;

// The unpacked bytes, exactly `size` of them; bytes after the stream are ignored. The caller checks
// `size` against kMaxInflation before: it is allocated at once. Fails (ErrorKind::Input) with
// `name` when the stream is broken, too short, too long or fails its checksum.
std::vector<std::uint8_t> inflateZlib(std::span<const std::uint8_t> stream, std::size_t size,
                                      const std::string& name);
