// What leaves mirrors and glass, sharp or rough, at the points of a block, a register of points at
// a time: what bounces(), mirrored() and leave() give, operation by operation and so bit by bit
// (the place in a rough lobe is rounded only where that is sure, else asked alone). Knows numbers
// only; render/waves/bounce_blocks.h brings them here and takes them away.
#pragma once

#include "material/material.h"
#include "render/waves/shade_lanes.h"

#include <cstddef>
#include <cstdint>
#include <span>

// Points of a block that have this in common. What has a Fresnel law mirrors or transmits
// something.
struct AlikePoints {
    unsigned points; // a bit for each
    const Material* material;
    float eta = 1;          // what refracts or is dielectric has one: see bounces()
    std::uint32_t beyond{}; // what refracted rays are inside of
};

// What rough points draw their pair of Sobol numbers by: Sampler::pairSeeds() and the number of the
// sample.
struct alignas(64) BouncePairs {
    std::uint32_t index[PointBlock::kPoints] = {}, x[PointBlock::kPoints] = {},
                  y[PointBlock::kPoints] = {}, sample[PointBlock::kPoints] = {};
};

// What leaves them. A ray's origin, direction and weight are where it goes.
struct LeavingRays {
    std::uint32_t rays = 0; // bit 2 i: point i reflects one, bit 2 i + 1: it refracts one
    std::size_t reflected = 0, refracted = 0; // how many
    std::uint32_t beyond[PointBlock::kPoints];
};

struct BounceLanes {
    // Those of the `used` points whose material, side and medium (a number for each) are those of
    // the first one, then the same of the others, and so on. Returns how many sets there are.
    std::size_t (*divide)(const PointBlock& block, const std::uint32_t* media, unsigned used,
                          std::uint16_t* alike) = nullptr;
    // In the order of the points, the reflected ray of each first; rays of less than `cutoff` are
    // not to be traced. Weights are those of the points. `pairs`: null if nothing is rough. Adds to
    // `leaving`.
    void (*bounce)(const PointBlock& block, const Rgb* weights, std::span<const AlikePoints> alike,
                   const BouncePairs* pairs, float cutoff, const RayPlaces& out,
                   LeavingRays& leaving) = nullptr;
    // The same of `points`, a bit for each, that are plain mirrors of their materials.
    void (*mirror)(const PointBlock& block, const Rgb* weights, const Material* const* materials,
                   unsigned points, float cutoff, const RayPlaces& out,
                   LeavingRays& leaving) = nullptr;
};
