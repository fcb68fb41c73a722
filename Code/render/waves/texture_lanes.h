// Colours of a texture at many points, a register of points at a time: what Texture::color() gives,
// operation by operation and so bit by bit. Knows numbers only: Texture says what they are.
#pragma once

#include "texture/byte_texture.h"

#include <cstddef>

struct alignas(64) TextureBlock {
    static constexpr std::size_t kPoints = 64;
    float u[kPoints] = {}, v[kPoints] = {};
    float color[3][kPoints];
};

// The first `count` points of the block; others may get colours too.
using TextureColorsFn = void (*)(const ByteTexture& texture, TextureBlock& block,
                                 std::size_t count);
