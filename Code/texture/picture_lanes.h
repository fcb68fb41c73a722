// Look-ups in pictures by the register: textures and the surroundings of the scene. Knows numbers
// only.
#pragma once

#include "texture/environment.h"
#include "texture/texture.h"

#include <cstddef>

struct alignas(64) TextureBlock {
    static constexpr std::size_t kPoints = 16;
    float u[kPoints] = {}, v[kPoints] = {};
    // The axes of footprints, of which colours are the mean: u, then v.
    bool isFiltered = false;
    alignas(64) float along[2][kPoints] = {}, across[2][kPoints] = {};
    float color[3][kPoints];
};

struct alignas(64) EnvironmentBlock {
    static constexpr std::size_t kRays = 64;
    float dir[3][kRays] = {};
    float color[3][kRays];
};

// Texture::color() and Environment::radiance() of the first `count` of a block; others may get
// colours too.
struct PictureLanes {
    void (*texture)(const Texture& texture, TextureBlock& block, std::size_t count);
    void (*environment)(const Environment& environment, EnvironmentBlock& block, std::size_t count);
};
