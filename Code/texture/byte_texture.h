// ByteTexels, ByteTexture: a texture of 8-bit numbers as plain data, for who looks up many points
// at once.
#pragma once

#include "texture/texel_grid.h"

#include <cstdint>
#include <span>

// TexelGrid of bytes, and the extensions that it is read with.
struct ByteTexels {
    std::span<const std::uint8_t> bytes;
    int width = 0, height = 0, channels = 0;
    bool isSrgb = false, isNearest = false;
    bool asksAlpha = false; // instead of the colour: three times the alpha
    Extension extensionS{}, extensionT{};
};

// Where it is looked up: (sFromU u + sFromV v) + offsetS, t likewise.
struct ByteTexture {
    ByteTexels texels;
    double sFromU = 0, sFromV = 0, tFromU = 0, tFromV = 0, offsetS = 0, offsetT = 0;
};
