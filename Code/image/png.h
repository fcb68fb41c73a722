// What the PNG reader and writer share (PNG specification, third edition).
// Private to image/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

// The filter of a row: what is subtracted from each byte. a is the byte one pixel to the left, b
// the one above, c the one above a; 0 outside of the picture.
enum class PngFilter : std::uint8_t { None, Sub, Up, Average, Paeth };
constexpr std::size_t kPngFilterCount = 5;

// The neighbour that is nearest to a + b - c; ties in the order a, b, c. In 16 bits: twice as many
// at once in vector code.
inline std::uint8_t paethPredictor(std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    const auto distance = [](int difference) {
        const auto d = static_cast<std::int16_t>(difference);
        return static_cast<std::int16_t>(d < 0 ? -d : d);
    };
    const std::int16_t toA = distance(b - c), toB = distance(a - c), toC = distance(a + b - 2 * c);
    const std::uint8_t bOrC = toB <= toC ? b : c;
    return toA <= toB && toA <= toC ? a : bOrC;
}
