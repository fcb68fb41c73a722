// What leaves mirrors and glass at many points of a wave, a register of points at a time: what
// bounces() and mirrored() give, operation by operation and so bit by bit. Knows numbers only;
// render/waves/bounce_blocks.h brings them here and takes them away.
#pragma once

#include "material/material.h"

#include <cstddef>
#include <cstdint>

struct Kernel;

// Lanes do this and plain mirrors.
inline bool isSharpGlass(const Material& material) {
    return material.roughness <= 0 && material.fresnel == FresnelModel::Dielectric;
}

struct alignas(64) BounceBlock {
    static constexpr std::size_t kPoints = 16;
    float n[3][kPoints] = {}, ng[3][kPoints] = {}, toEye[3][kPoints] = {};
    float mirror[3][kPoints] = {}, transmission[3][kPoints] = {}, eta[kPoints] = {};
    float weight[3][kPoints] = {}, cutoff = 0; // of the points; rays of less are not traced
    alignas(64) float reflectedDir[3][kPoints], reflected[3][kPoints]; // and the rays' weights
    float refractedDir[3][kPoints], refracted[3][kPoints];
    unsigned used = 0, glass = 0; // a bit for each point; who is no glass is a plain mirror
    // Bits of the points that reflect and refract something to trace, and of those whose bent
    // normals ask for more than lanes do.
    unsigned reflects, refracts, bent;
};

using BouncesFn = void (*)(BounceBlock& block);
// Null for the scalar kernel.
BouncesFn bouncesInLanes(const Kernel& kernel);
