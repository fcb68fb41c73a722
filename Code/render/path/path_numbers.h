// The random numbers of sixteen points of a path: four pairs each, in the slots of
// sample/dimensions.h.
#pragma once

#include "render/integrator.h"
#include "render/path/path_block.h"
#include "render/path/whitted_block.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

// The pairs of one dimension of sixteen points: `repeats` samples of each, as Sampler::stream()
// numbers them.
inline void drawPairs(const IntegratorContext& context, const Sampler& sampler,
                      std::uint32_t dimension, const std::uint32_t (&pixels)[PointBlock::kPoints],
                      const std::uint32_t (&samples)[PointBlock::kPoints], std::uint32_t repeats,
                      PlacesOnLamp* to) {
    constexpr std::size_t kPoints = PointBlock::kPoints;
    constexpr std::uint32_t kTogether = PairBlock::kPairs / kPoints;
    const CameraLanes lanes = lanesOf(context.settings.isa->camera);
    if (sampler.kind() != SamplerKind::Sobol || lanes.pairs == nullptr) {
        for (std::uint32_t s = 0; s < repeats; ++s)
            for (std::size_t i = 0; i < kPoints; ++i) {
                const Vec2 pair = sampler.get2D(pixels[i], samples[i] * repeats + s, dimension);
                to[s].u[i] = pair.x, to[s].v[i] = pair.y;
            }
        return;
    }
    PairBlock pairs;
    lanes.seeds(sampler.seed(), dimension, std::span<const std::uint32_t>(pixels),
                {pairs.index, pairs.x, pairs.y});
    for (std::uint32_t k = 1; k < kTogether; ++k)
        for (std::uint32_t* const column : {pairs.index, pairs.x, pairs.y})
            std::copy_n(column, kPoints, column + k * kPoints);
    for (std::uint32_t first = 0; first < repeats; first += kTogether) {
        for (std::uint32_t k = 0; k < kTogether; ++k)
            for (std::size_t i = 0; i < kPoints; ++i)
                pairs.sample[k * kPoints + i] = samples[i] * repeats + first + k;
        lanes.pairs(pairs);
        for (std::uint32_t k = 0; k < std::min(kTogether, repeats - first); ++k, ++to) {
            std::copy_n(pairs.u + k * kPoints, kPoints, to->u);
            std::copy_n(pairs.v + k * kPoints, kPoints, to->v);
        }
    }
}

// `pixels` and `samples`: of all sixteen points.
inline void drawNumbers(const IntegratorContext& context, int depth,
                        const std::uint32_t (&pixels)[PointBlock::kPoints],
                        const std::uint32_t (&samples)[PointBlock::kPoints], PathNumbers& out) {
    constexpr std::size_t kPoints = PointBlock::kPoints;
    struct Slot {
        BounceSlot slot;
        float *u, *v;
    };
    const Slot slots[] = {{BounceSlot::LightPick, out.light, out.lobe},
                          {BounceSlot::LightUv, out.lightU, out.lightV},
                          {BounceSlot::BsdfUv, out.bsdfU, out.bsdfV},
                          {BounceSlot::Roulette, out.roulette, out.spare}};
    static_assert(std::size(slots) * kPoints == PairBlock::kPairs);
    const CameraLanes lanes = lanesOf(context.settings.isa->camera);
    if (context.sampler.kind() != SamplerKind::Sobol || lanes.pairs == nullptr) {
        for (const Slot& slot : slots)
            for (std::size_t i = 0; i < kPoints; ++i) {
                const Vec2 pair =
                    context.sampler.get2D(pixels[i], samples[i], dimension(depth, slot.slot));
                slot.u[i] = pair.x, slot.v[i] = pair.y;
            }
        return;
    }
    PairBlock pairs;
    for (std::size_t s = 0; s < std::size(slots); ++s) {
        const std::size_t at = s * kPoints;
        std::copy_n(samples, kPoints, pairs.sample + at);
        lanes.seeds(context.sampler.seed(), dimension(depth, slots[s].slot),
                    std::span<const std::uint32_t>(pixels),
                    {pairs.index + at, pairs.x + at, pairs.y + at});
    }
    lanes.pairs(pairs);
    for (std::size_t s = 0; s < std::size(slots); ++s) {
        std::copy_n(pairs.u + s * kPoints, kPoints, slots[s].u);
        std::copy_n(pairs.v + s * kPoints, kPoints, slots[s].v);
    }
}
