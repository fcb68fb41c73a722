#include "image/checksum.h"

#include "image/byte_lanes.h"

#include <algorithm>
#include <array>

namespace {

// kCrc[k][b]: what byte b does to the remainder when k zero bytes follow (slicing by 8, Intel
// 2006; here by 16: more of the bytes need not wait for the remainder before them).
constexpr std::size_t kSlices = 16;
constexpr auto kCrc = [] {
    std::array<std::array<std::uint32_t, 256>, kSlices> table{};
    for (std::uint32_t b = 0; b < 256; ++b) {
        std::uint32_t c = b;
        for (int bit = 0; bit < 8; ++bit) c = (c & 1) ? (c >> 1) ^ kCrcPolynomial : c >> 1;
        table[0][b] = c;
    }
    for (std::size_t k = 1; k < kSlices; ++k)
        for (std::size_t b = 0; b < 256; ++b)
            table[k][b] = (table[k - 1][b] >> 8) ^ table[0][table[k - 1][b] & 255];
    return table;
}();

// Without the inversions at the start and the end.
std::uint32_t crcByTables(std::span<const std::uint8_t> bytes, std::uint32_t c) {
    std::size_t i = 0;
    for (; i + kSlices <= bytes.size(); i += kSlices) {
        std::uint32_t sum = 0;
#pragma GCC unroll 16
        for (std::size_t behind = 0; behind < kSlices; ++behind) { // those that need c last
            const std::size_t k = kSlices - 1 - behind;
            const std::uint32_t byte = bytes[i + k] ^ (k < 4 ? c >> (8 * k) & 255 : 0);
            sum ^= kCrc[behind][byte];
        }
        c = sum;
    }
    for (; i < bytes.size(); ++i) c = kCrc[0][(c ^ bytes[i]) & 255] ^ (c >> 8);
    return c;
}

constexpr std::uint32_t kModulus = 65521; // of Adler-32: the largest prime below 2^16

} // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before) {
    CrcBytes folded{};
    const std::size_t used = byteLanes().foldForCrc(~before, bytes, folded);
    return ~crcByTables(bytes.subspan(used), used > 0 ? crcByTables(folded, 0) : ~before);
}

std::uint32_t adler32(std::span<const std::uint8_t> bytes, std::uint32_t before) {
    constexpr std::size_t kNoOverflow = 5552; // the longest run that keeps b below 2^32 (zlib)
    const ByteLanes& lanes = byteLanes();
    AdlerSums sums{before & 0xFFFF, before >> 16};
    while (!bytes.empty()) {
        const auto part = bytes.first(std::min(bytes.size(), kNoOverflow));
        bytes = bytes.subspan(part.size());
        for (const std::uint8_t byte : part.subspan(lanes.addToAdler(sums, part))) {
            sums.a += byte;
            sums.b += sums.a;
        }
        sums.a %= kModulus;
        sums.b %= kModulus;
    }
    return sums.b << 16 | sums.a;
}

// a = 1 + the bytes; b = the sum of a after each byte. The second part began with a = 1 instead of
// the first part's a, which is missing once in a and once per byte in b.
std::uint32_t adler32Joined(std::uint32_t first, std::uint32_t second, std::size_t secondSize) {
    const std::uint64_t missing = (first & 0xFFFF) + std::uint64_t{kModulus} - 1;
    const std::uint64_t a = (second & 0xFFFF) + missing;
    const std::uint64_t b = (first >> 16) + (second >> 16) + secondSize % kModulus * missing;
    return static_cast<std::uint32_t>(b % kModulus << 16 | a % kModulus);
}
