// A PNG file as its chunks say it is: everything but the pixels, which are still packed.
// Private to image/.
#pragma once

#include "image/formats.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

// Samples of 16 bits have the high byte first.
inline std::uint16_t wordAt(Bytes bytes, std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

// Ancillary chunks other than tRNS are skipped. Fails with "name: error: what".
PngChunks readPngChunks(Bytes file, const std::string& name);
