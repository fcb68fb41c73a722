// Camera rays by the register: places in the picture, and the rays through them. Knows numbers
// only; render/camera_rays.cpp brings them here and takes them away.
#pragma once

#include "camera/camera.h"
#include "sample/filter.h"
#include "sample/pair_block.h"
#include "sample/sampler.h"
#include "sample/z_order.h"

#include <cstddef>
#include <cstdint>
#include <span>

// Places in the picture, in pixels, and on the lens, in the unit square: one per pair of a block.
struct alignas(64) PlaceBlock {
    static constexpr std::size_t kPlaces = PairBlock::kPairs;
    double x[kPlaces], y[kPlaces];
    float u[kPlaces], v[kPlaces]; // cameras without a lens leave them alone
};

// The rays through the first places of a block, all of one size.
struct RaySpans {
    std::span<Vec3> org, dir;
    std::span<float> tMin;
    std::span<const float> time; // is read, in [0,1] of the shutter
};

struct CameraLanes {
    // pairSeeds(), zPairSeeds(), sobolPairs() and zSobolPairs() of sample/pairs_in_lanes.h.
    void (*seeds)(std::uint32_t seed, std::uint32_t dimension,
                  std::span<const std::uint32_t> pixels, const PairSeedColumns& to);
    void (*zSeeds)(const ZOrder& order, std::span<const std::uint32_t> pixels,
                   const PairSeedColumns& to);
    void (*pairs)(PairBlock& block, std::size_t count);
    void (*zPairs)(PairBlock& block, std::size_t count, int sampleBits);
    // Moves places by Filter::sample() of what pairs() has drawn.
    void (*spread)(const Filter::Spread& filter, const PairBlock& pairs, PlaceBlock& places);
    // Camera::ray() through each place.
    void (*rays)(const Camera& camera, const PlaceBlock& places, const RaySpans& to);

    // Sampler::pairSeeds() of pixels, a multiple of 16, and the pairs that they lead to, of a
    // sampler in lanes.
    void seedsOf(const Sampler& sampler, std::uint32_t dimension,
                 std::span<const std::uint32_t> pixels, const PairSeedColumns& to) const {
        if (sampler.kind() == SamplerKind::ZSobol)
            zSeeds(sampler.zOrder(dimension), pixels, to);
        else
            seeds(sampler.seed(), dimension, pixels, to);
    }
    void pairsOf(const Sampler& sampler, PairBlock& block, std::size_t count) const {
        if (sampler.kind() == SamplerKind::ZSobol)
            zPairs(block, count, sampler.sampleBits());
        else
            pairs(block, count);
    }
};
