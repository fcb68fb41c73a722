// Look-ups in pictures by the register: textures, checkers and the surroundings of the scene, and
// what rays stand for. Knows numbers only.
#pragma once

#include "base/transform.h"
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

// Cones, and the surfaces that they meet.
struct alignas(64) FootprintBlock {
    static constexpr std::size_t kPoints = TextureBlock::kPoints;
    using Lane = float[kPoints];
    // In. `dir`: the unit directions of the rays; `normal`: of the geometry.
    Lane width = {}, dir[3] = {}, normal[3] = {}, dpdu[3] = {}, dpdv[3] = {};
    // Out: as of TextureBlock.
    Lane along[2], across[2];

    void put(std::size_t i, float wide, Vec3 way, Vec3 n) {
        width[i] = wide;
        dir[0][i] = way.x, dir[1][i] = way.y, dir[2][i] = way.z;
        normal[0][i] = n.x, normal[1][i] = n.y, normal[2][i] = n.z;
    }
    void put(std::size_t i, const SurfaceDerivatives& d) {
        dpdu[0][i] = d.dpdu.x, dpdu[1][i] = d.dpdu.y, dpdu[2][i] = d.dpdu.z;
        dpdv[0][i] = d.dpdv.x, dpdv[1][i] = d.dpdv.y, dpdv[2][i] = d.dpdv.z;
    }
};
// Cones that meet a plane with squares.
struct CheckerBlock : FootprintBlock {
    Lane org[3] = {}, t[2] = {}; // of the rays; t is their sum
    Lane odd;                    // out: the part of the footprint that lies on odd squares
};

struct alignas(64) EnvironmentBlock {
    static constexpr std::size_t kRays = 64;
    float dir[3][kRays] = {};
    float color[3][kRays];
};

// Texture::color(), Environment::radiance() and so on of the first `count` of a block; others may
// get numbers too.
struct PictureLanes {
    void (*texture)(const Texture& texture, TextureBlock& block, std::size_t count);
    void (*environment)(const Environment& environment, EnvironmentBlock& block, std::size_t count);
    void (*footprints)(FootprintBlock& block, std::size_t count);
    void (*oddParts)(const AffineRows& planeFromWorld, CheckerBlock& block, std::size_t count);
};
