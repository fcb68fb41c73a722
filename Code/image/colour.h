// sRGB transfer (IEC 61966-2-1, thresholds 0.04045 and 0.0031308) and rounding to whole codes.
// The bits are the same on every machine: only + - * / and tables made by them, never std::pow.
// Everything is clamped to [0,1]; NaN counts as 0. Knows nothing about pictures.
#pragma once

#include "base/vec.h"

#include <cstdint>
#include <span>

// Within 1 ulp of the exact value.
float srgbFromLinear(float linear);

// Correctly rounded decode of whole codes.
float linearFromSrgb8(std::uint8_t code);
float linearFromSrgb16(std::uint16_t code);
// round(255 * srgb(x)) and round(65535 * srgb(x)) of the exact value.
std::uint8_t srgb8FromLinear(float linear);
std::uint16_t srgb16FromLinear(float linear);
// Many at once: three codes per pixel.
void srgb8FromLinear(std::span<const Rgb> pixels, std::uint8_t* out);

// What texture/texels_in_lanes.h decodes numbers between codes by. Up to the thresholds it is
// encoded / 12.92 and 12.92 * linear. A node is the curve's value at k / 255 and
// 1 / (k / 255 + 0.055).
namespace srgb {
struct DecodeNode {
    double value, inverse;
};
inline constexpr double kDecodeThreshold = 0.04045, kEncodeThreshold = 0.0031308;
std::span<const DecodeNode, 256> decodeNodes();
} // namespace srgb

// Without a transfer: code / 255 or code / 65535, and round(255 * x), round(65535 * x).
inline float unitFrom8(std::uint8_t code) { return static_cast<float>(code / 255.0); }
inline float unitFrom16(std::uint16_t code) { return static_cast<float>(code / 65535.0); }
constexpr float clampToUnit(float x) { return !(x > 0) ? 0.0f : x < 1 ? x : 1.0f; }
// The product is exact in double.
constexpr std::uint8_t unit8From(float x) {
    return static_cast<std::uint8_t>(static_cast<double>(clampToUnit(x)) * 255 + 0.5);
}
constexpr std::uint16_t unit16From(float x) {
    return static_cast<std::uint16_t>(static_cast<double>(clampToUnit(x)) * 65535 + 0.5);
}
