// Camera rays by the register: pairs of Sobol numbers, and rays through a round lens or a pinhole,
// as Sampler and Camera give them one by one, operation by operation and so bit by bit. Knows
// numbers only; render/camera_rays.cpp brings them here and takes them away.
#pragma once

#include "camera/camera.h"
#include "sample/filter.h"

#include <cstddef>
#include <cstdint>
#include <span>

// Pixels, numbers of samples, what their pairs are shuffled and scrambled by, and the pairs.
struct alignas(64) PairBlock {
    static constexpr std::size_t kPairs = 64;
    std::uint32_t pixel[kPairs], sample[kPairs], index[kPairs], x[kPairs], y[kPairs];
    float u[kPairs], v[kPairs];
};

// Places in the picture, in pixels, and on the lens, in the unit square: one per pair of a block.
struct alignas(64) PlaceBlock {
    static constexpr std::size_t kPlaces = PairBlock::kPairs;
    double x[kPlaces], y[kPlaces];
    float u[kPlaces], v[kPlaces];
};

// The rays through the first places of a block, all of one size.
struct RaySpans {
    std::span<Vec3> org, dir; // pinholes leave org alone, which may be empty
    std::span<float> tMin;
};

// Sampler::pairSeeds() of each pixel, of a sampler of that seed; the pixels are a multiple of 16.
struct PairSeedColumns {
    std::uint32_t *index, *x, *y;
};
using PairSeedsFn = void (*)(std::uint32_t seed, std::uint32_t dimension,
                             std::span<const std::uint32_t> pixels, const PairSeedColumns& to);

struct CameraLanes {
    PairSeedsFn seeds = nullptr;
    // The first `count` pairs of a block, a multiple of 16.
    void (*pairs)(PairBlock& block, std::size_t count) = nullptr;
    // Moves places by Filter::sample() of what pairs() has drawn.
    void (*spread)(const Filter::Spread& filter, const PairBlock& pairs,
                   PlaceBlock& places) = nullptr;
    void (*rays)(const Camera::Lens& lens, const PlaceBlock& places, const RaySpans& to) = nullptr;
    // Camera::pinholeRays()
    void (*pinhole)(const Camera::Lens& lens, const PlaceBlock& places,
                    const RaySpans& to) = nullptr;
};
