// Colours of a texture at many points, a register of points at a time: what Texture::color() gives,
// operation by operation and so bit by bit. Knows numbers only: Texture says what they are.
#pragma once

#include "texture/environment.h"
#include "texture/texture.h"

#include <cstddef>

struct alignas(64) TextureBlock {
    static constexpr std::size_t kPoints = 64;
    float u[kPoints] = {}, v[kPoints] = {};
    float color[3][kPoints];
};

// The first `count` points of the block; others may get colours too.
using TextureColorsFn = void (*)(const ByteTexture& texture, TextureBlock& block,
                                 std::size_t count);

// What rays in many directions see of the picture around the scene, a register of them at a time:
// Environment::radiance(), operation by operation and so bit by bit.

struct alignas(64) EnvironmentBlock {
    static constexpr std::size_t kRays = 64;
    float dir[3][kRays] = {};
    double s[kRays], t[kRays]; // Environment::Place, if the picture is not of bytes
    float color[3][kRays];     // if it is
};

// The first `count` rays of the block; others may be answered too. Null for the scalar kernel.
using EnvironmentColorsFn = void (*)(const Environment::View& view, EnvironmentBlock& block,
                                     std::size_t count);

// Look-ups in pictures by the register: textures and the surroundings of the scene.

struct PictureLanes {
    TextureColorsFn texture = nullptr;
    EnvironmentColorsFn environment = nullptr;
};
