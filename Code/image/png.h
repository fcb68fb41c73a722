// What the PNG reader and writer share (PNG specification, third edition): the filters of rows, and
// a file's chunks.
// Private to image/.
#pragma once

#include "image/formats.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

// What is subtracted from each byte of a row. a is the byte one pixel to the left, b the one above,
// c the one above a; 0 outside of the picture. Pixels have 1, 2, 3, 4, 6 or 8 bytes, 1 where they
// are smaller; `above` is as long as the row, and all zero for the first one.
enum class PngFilter : std::uint8_t { None, Sub, Up, Average, Paeth };
inline constexpr std::size_t kPngFilterCount = 5;

// Writes the row to `out` with the filter whose bytes, as signed numbers without their signs, have
// the smallest sum (12.7; of equal sums the first filter). Returns which.
PngFilter filterRow(Bytes row, Bytes above, std::size_t pixelBytes, std::span<std::uint8_t> out);
// The row as it was before the filter, in its place.
void unfilterRow(PngFilter filter, std::span<std::uint8_t> row, Bytes above,
                 std::size_t pixelBytes);

enum PngColourType : unsigned {
    kPngGrey = 0,
    kPngRgb = 2,
    kPngPalette = 3,
    kPngGreyAlpha = 4,
    kPngRgba = 6
};

struct PngHeader {
    std::size_t width = 0, height = 0;
    unsigned depth = 0, colourType = 0; // bits per sample
    bool isInterlaced = false;

    std::size_t samples() const { // per pixel in the file
        switch (colourType) {
        case kPngRgb: return 3;
        case kPngGreyAlpha: return 2;
        case kPngRgba: return 4;
        default: return 1;
        }
    }
    std::size_t rowBytes(std::size_t columns) const {
        return (columns * samples() * depth + 7) / 8;
    }
};

struct PngColour {
    std::uint8_t r = 0, g = 0, b = 0, alpha = 255;
};

// Everything but the pixels, and the packed pixels in pieces.
struct PngChunks {
    PngHeader header;
    std::vector<PngColour> palette;
    std::optional<std::array<std::uint16_t, 3>> transparent; // the colour whose alpha is 0
    bool hasPaletteAlpha = false;
    std::vector<std::uint8_t> packed;
};

// Ancillary chunks other than tRNS are skipped. Fails with "name: error: what".
PngChunks readPngChunks(Bytes file, const std::string& name);
