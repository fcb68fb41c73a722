#include "image/colour.h"

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

namespace {

using srgb::DecodeNode, srgb::kDecodeThreshold, srgb::kEncodeThreshold;

constexpr double power(double x, int exponent) {
    double product = 1;
    for (int i = 0; i < exponent; ++i) product *= x;
    return product;
}

// The n-th root of y > 0 by Newton's iteration. After one step from any start the iterates fall
// towards the root, so the first one that does not fall is the end.
constexpr double root(double y, int n, double start) {
    const auto step = [&](double t) { return t - (t - y / power(t, n - 1)) / n; };
    double t = step(start);
    for (double next = step(t); next < t; next = step(t)) t = next;
    return t;
}

// x^2.4 = x^2 * fifth root of x^2
constexpr double decodeCurve(double encoded, double start = 1) {
    const double x = (encoded + 0.055) / 1.055;
    return x * x * root(x * x, 5, start);
}
constexpr double decode(double encoded, double start = 1) {
    return encoded <= kDecodeThreshold ? encoded / 12.92 : decodeCurve(encoded, start);
}

// A node of the decoding table: the curve's value there (also left of the threshold, since floats
// between both use the node 10) and 1 / (encoded + 0.055).
constexpr auto kDecode = [] {
    std::array<DecodeNode, 256> table{};
    for (int k = 0; k < 256; ++k) {
        const double encoded = k / 255.0;
        table[static_cast<std::size_t>(k)] = {decodeCurve(encoded), 1 / (encoded + 0.055)};
    }
    return table;
}();

// A node of the encoding table: the middle of a 32nd of an octave in [2^-9, 1).
struct EncodeNode {
    double value, inverse; // x^(1/2.4) and 1 / x
};
constexpr int kEncodeOctaves = 9, kEncodeBits = 5;
constexpr auto kEncode = [] {
    std::array<EncodeNode, kEncodeOctaves << kEncodeBits> table{};
    double octave = 1.0 / (1 << kEncodeOctaves);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const std::size_t part = i % (1 << kEncodeBits);
        const double x = octave * (1 + (static_cast<double>(part) + 0.5) / (1 << kEncodeBits));
        table[i] = {root(power(x, 5), 12, 1.0), 1 / x};
        if (part + 1 == 1 << kEncodeBits) octave *= 2;
    }
    return table;
}();

// Buckets of floats in [2^-octaves, 1) by their exponent and first mantissa bits. Smaller values
// have code 0.
constexpr std::size_t bucketOf(float x, int octaves, int bits) {
    const std::uint32_t lowest = static_cast<std::uint32_t>(127 - octaves) << bits;
    return (std::bit_cast<std::uint32_t>(x) >> (23 - bits)) - lowest;
}

// The smallest float of each code: round(maxCode * srgb(x)) >= code exactly when x >= this.
constexpr float lowestOfCode(int code, int maxCode, double start) {
    const double exact = decode((code - 0.5) / maxCode, start);
    const float nearest = static_cast<float>(exact);
    if (static_cast<double>(nearest) >= exact) return nearest;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);
}

// 8 bits: a bucket is so small that it holds at most one boundary. Its entry is the code of its
// smallest float times 2^16, plus what makes the bits of a float behind those of the bucket carry
// from the boundary on: one look-up and one sum, no decision.
constexpr int kOctaves8 = 13, kBits8 = 7;
constexpr std::uint32_t kInside8 = (1u << (23 - kBits8)) - 1; // the bits behind the bucket
constexpr auto kEncode8 = [] {
    std::array<float, 257> lowest{};
    for (int code = 1; code < 256; ++code)
        lowest[static_cast<std::size_t>(code)] = lowestOfCode(code, 255, 1);
    lowest[256] = 2;
    std::array<std::uint32_t, kOctaves8 << kBits8> table{};
    std::uint32_t bits = static_cast<std::uint32_t>(127 - kOctaves8) << 23;
    std::uint32_t code = 0;
    for (std::uint32_t& entry : table) {
        while (std::bit_cast<float>(bits) >= lowest[code + 1]) ++code;
        const std::uint32_t boundary = std::bit_cast<std::uint32_t>(lowest[code + 1]);
        entry = code << 16;
        if (boundary <= (bits | kInside8)) entry += kInside8 + 1 - (boundary & kInside8);
        bits += kInside8 + 1;
    }
    return table;
}();
static_assert(kInside8 == 0xFFFF, "the bits behind the bucket carry into the code");
static_assert(kEncode8[0] == 0 && kEncode8.back() >> 16 == 255);
// Smaller values have the code of kLeast8, larger ones that of kMost8.
constexpr float kLeast8 = 1.0f / (1 << kOctaves8), kMost8 = 0x1.fffffep-1f;

// 16 bits: a straight line through the bucket guesses the code, the boundaries correct it.
constexpr int kOctaves16 = 21, kBits16 = 10;
struct Tables16 {
    std::vector<float> decoded = std::vector<float>(65536);
    std::vector<float> lowest = std::vector<float>(65537);
    std::vector<std::uint16_t> first = std::vector<std::uint16_t>((kOctaves16 << kBits16) + 1);
};
// A function instead of a lambda, which g++ would run for four seconds to see whether it is
// constant.
Tables16 makeTables16() {
    Tables16 made;
    double start = 1; // the root of the code before: one or two steps to the next
    for (int code = 0; code < 65536; ++code) {
        const double encoded = code / 65535.0, x = (encoded + 0.055) / 1.055;
        const auto at = static_cast<std::size_t>(code);
        const double value = decode(encoded, start);
        made.decoded[at] = static_cast<float>(value);
        if (code > 0) made.lowest[at] = lowestOfCode(code, 65535, start);
        if (encoded > kDecodeThreshold) start = value / (x * x);
    }
    made.lowest[65536] = 2;
    std::uint32_t bits = static_cast<std::uint32_t>(127 - kOctaves16) << 23;
    std::uint32_t code = 0;
    for (std::uint16_t& first : made.first) {
        while (code < 65535 && std::bit_cast<float>(bits) >= made.lowest[code + 1]) ++code;
        first = static_cast<std::uint16_t>(code);
        bits += 1u << (23 - kBits16);
    }
    return made;
}
// They are made at the first use, in about 10 ms.
const Tables16& tables16() {
    static const Tables16 tables = makeTables16();
    return tables;
}

} // namespace

std::span<const DecodeNode, 256> srgb::decodeNodes() { return kDecode; }

float srgbFromLinear(float linear) {
    const double x = static_cast<double>(clampToUnit(linear));
    if (x <= kEncodeThreshold) return static_cast<float>(12.92 * x);
    if (x >= 1) return 1;
    const EncodeNode& node = kEncode[bucketOf(linear, kEncodeOctaves, kEncodeBits)];
    // (1 + u)^(5/12) by the binomial series; |u| < 0.016, the next term is below 3e-11.
    const double u = x * node.inverse - 1;
    constexpr double a = 5.0 / 12, b = a * (a - 1) / 2, c = b * (a - 2) / 3, d = c * (a - 3) / 4;
    const double raised = node.value * (1 + u * (a + u * (b + u * (c + u * d))));
    return static_cast<float>(1.055 * raised - 0.055);
}

float linearFromSrgb8(std::uint8_t code) {
    const double encoded = code / 255.0;
    return static_cast<float>(encoded <= kDecodeThreshold ? encoded / 12.92 : kDecode[code].value);
}

float linearFromSrgb16(std::uint16_t code) { return tables16().decoded[code]; }

std::uint8_t srgb8FromLinear(float linear) {
    const float x = linear > kLeast8 ? linear : kLeast8; // also instead of NaN
    const float inTable = x < kMost8 ? x : kMost8;
    const std::uint32_t entry = kEncode8[bucketOf(inTable, kOctaves8, kBits8)];
    const std::uint32_t inside = std::bit_cast<std::uint32_t>(inTable) & kInside8;
    return static_cast<std::uint8_t>((entry + inside) >> 16);
}

void srgb8FromLinear(std::span<const Rgb> pixels, std::uint8_t* out) {
    for (const Rgb& pixel : pixels)
        for (const float value : {pixel.r, pixel.g, pixel.b}) *out++ = srgb8FromLinear(value);
}

std::uint16_t srgb16FromLinear(float linear) {
    if (!(linear >= 1.0f / (1 << kOctaves16))) return 0;
    if (linear >= 1) return 65535;
    const Tables16& tables = tables16();
    const std::size_t bucket = bucketOf(linear, kOctaves16, kBits16);
    const std::uint32_t first = tables.first[bucket], next = tables.first[bucket + 1];
    constexpr std::uint32_t kInside = (1u << (23 - kBits16)) - 1;
    const std::uint32_t inside = std::bit_cast<std::uint32_t>(linear) & kInside;
    std::uint32_t code = first + ((next - first) * inside >> (23 - kBits16));
    while (linear < tables.lowest[code]) --code;
    while (linear >= tables.lowest[code + 1]) ++code;
    return static_cast<std::uint16_t>(code);
}
