// HALF numbers of OpenEXR: IEEE 754 binary16, with 5 bits of exponent and 10 of fraction.
// Private to image/.
#pragma once

#include <bit>
#include <cstdint>

// Returns the same number; infinity and NaN stay what they are.
inline float floatFromHalf(std::uint16_t half) {
    const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000) << 16;
    const std::uint32_t exponent = half >> 10 & 31, fraction = half & 0x3FF;
    if (exponent == 0) { // a multiple of 2^-24
        const float magnitude = static_cast<float>(fraction) * 0x1p-24f;
        return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(magnitude));
    }
    const std::uint32_t wide = exponent == 31 ? 255 : exponent + (127 - 15);
    return std::bit_cast<float>(sign | wide << 23 | fraction << 13);
}

// Returns the nearest HALF, of two equally near the one whose last bit is 0. Numbers of 65520 and
// more become the largest finite one, 65504; NaN stays NaN.
inline std::uint16_t halfFromFloat(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7FFFFFFF;
    constexpr std::uint32_t kInfinity = 0x7F800000, k65520 = 0x477FF000, kLeastNormal = 0x38800000;
    std::uint32_t half = 0;
    if (magnitude > kInfinity) {
        half = 0x7E00;
    } else if (magnitude >= k65520) {
        half = 0x7BFF;
    } else if (magnitude >= kLeastNormal) { // 13 bits of the fraction go; a carry is right
        const std::uint32_t rounded = magnitude + 0xFFF + (magnitude >> 13 & 1);
        half = (rounded - ((127u - 15) << 23)) >> 13;
    } else if (const std::uint32_t exponent = magnitude >> 23; exponent >= 102) { // from 2^-25
        const std::uint32_t fraction = (magnitude & 0x7FFFFF) | 0x800000;
        const std::uint32_t shift = 126 - exponent; // to a multiple of 2^-24
        half = (fraction + (1u << (shift - 1)) - 1 + (fraction >> shift & 1)) >> shift;
    }
    return static_cast<std::uint16_t>(sign | half);
}
