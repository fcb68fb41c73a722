// Camera rays by the register: pairs of Sobol numbers, and rays through a round lens or a pinhole,
// as Sampler and Camera give them one by one, operation by operation and so bit by bit. Knows
// numbers only; render/camera_rays.cpp brings them here and takes them away.
#pragma once

#include "camera/camera.h"
#include "sample/filter.h"

#include <cstddef>
#include <cstdint>

struct Kernel;

// Pixels, numbers of samples, what their pairs are shuffled and scrambled by, and the pairs.
struct alignas(64) PairBlock {
    static constexpr std::size_t kPairs = 64;
    std::uint32_t pixel[kPairs] = {}, sample[kPairs] = {}, index[kPairs] = {}, x[kPairs] = {},
                  y[kPairs] = {};
    float u[kPairs], v[kPairs];
};

// Places in the picture and on the lens, the latter in the unit square, and their rays.
struct alignas(64) LensBlock {
    static constexpr std::size_t kRays = 64;
    double x[kRays] = {}, y[kRays] = {};
    float u[kRays] = {}, v[kRays] = {};
    float org[3][kRays], dir[3][kRays], tMin[kRays];
};

// Sampler::pairSeeds() of each pixel, of a sampler of that seed; the pixels are a multiple of 16.
struct PairSeedColumns {
    std::uint32_t *index, *x, *y;
};
using PairSeedsFn = void (*)(std::uint32_t seed, std::uint32_t dimension,
                             std::span<const std::uint32_t> pixels, const PairSeedColumns& to);

struct CameraLanes {
    PairSeedsFn seeds = nullptr;
    void (*pairs)(PairBlock& block) = nullptr;
    // Filter::sample() of what pairs() has drawn.
    void (*spread)(const Filter::Inverse& filter, PairBlock& block) = nullptr;
    void (*rays)(const Camera::Lens& lens, LensBlock& block) = nullptr;
    // Camera::pinholeRays()
    void (*pinhole)(const Camera::Lens& lens, std::span<const Vec2d> places, std::span<Vec3> dir,
                    std::span<float> tMin) = nullptr;
};
// Null for the scalar kernel.
CameraLanes cameraLanes(const Kernel& kernel);
