// ByteTexture: a texture of 8-bit numbers as plain data, for who looks up many points at once.
#pragma once

#include "texture/texel_grid.h"

#include <cstdint>
#include <span>

// Where it is looked up: (sFromU u + sFromV v) + offsetS, t likewise.
struct ByteTexture {
    std::span<const std::uint8_t> bytes;
    int width = 0, height = 0, channels = 0;
    bool isSrgb = false, isNearest = false;
    bool asksAlpha = false; // instead of the colour: three times the alpha
    Extension extension{};
    double sFromU = 0, sFromV = 0, tFromU = 0, tFromV = 0, offsetS = 0, offsetT = 0;
};
