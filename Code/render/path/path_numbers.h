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

// Draws pairs of one dimension for sixteen points, some samples of one lamp after the other, as
// Sampler::stream() numbers them. Lanes draw four samples at a time, of whichever lamps.
class PairDrawer {
public:
    static constexpr std::size_t kPoints = PointBlock::kPoints;

    // `pixels` and `samples` stay as long as this.
    PairDrawer(const IntegratorContext& context, std::uint32_t dimension,
               const std::uint32_t (&pixels)[kPoints], const std::uint32_t (&samples)[kPoints])
        : lanes_(lanesOf(context.settings.isa->camera)), dimension_(dimension), pixels_(pixels),
          samples_(samples) {}
    ~PairDrawer() { flush(); }
    PairDrawer(const PairDrawer&) = delete;
    PairDrawer& operator=(const PairDrawer&) = delete;

    // The pairs of `repeats` samples, which are written until the drawer's life ends.
    void draw(const Sampler& sampler, std::uint32_t repeats, PlacesOnLamp* to) {
        if (sampler.kind() != SamplerKind::Sobol || lanes_.pairs == nullptr) {
            for (std::uint32_t s = 0; s < repeats; ++s)
                for (std::size_t i = 0; i < kPoints; ++i) {
                    const Vec2 pair =
                        sampler.get2D(pixels_[i], samples_[i] * repeats + s, dimension_);
                    to[s].u[i] = pair.x, to[s].v[i] = pair.y;
                }
            return;
        }
        std::size_t seeds = 0; // where the lamp's first seeds are
        for (std::uint32_t s = 0; s < repeats; ++s) {
            const std::size_t at = count_ * kPoints;
            if (s == 0 || count_ == 0) {
                lanes_.seeds(sampler.seed(), dimension_, std::span<const std::uint32_t>(pixels_),
                             {pairs_.index + at, pairs_.x + at, pairs_.y + at});
                seeds = at;
            } else {
                for (std::uint32_t* const column : {pairs_.index, pairs_.x, pairs_.y})
                    std::copy_n(column + seeds, kPoints, column + at);
            }
            for (std::size_t i = 0; i < kPoints; ++i)
                pairs_.sample[at + i] = samples_[i] * repeats + s;
            to_[count_++] = to + s;
            if (count_ == kTogether) flush();
        }
    }

private:
    static constexpr std::size_t kTogether = PairBlock::kPairs / kPoints;

    void flush() {
        if (count_ == 0) return;
        lanes_.pairs(pairs_);
        for (std::size_t k = 0; k < count_; ++k) {
            std::copy_n(pairs_.u + k * kPoints, kPoints, to_[k]->u);
            std::copy_n(pairs_.v + k * kPoints, kPoints, to_[k]->v);
        }
        count_ = 0;
    }

    CameraLanes lanes_;
    std::uint32_t dimension_;
    const std::uint32_t (&pixels_)[kPoints];
    const std::uint32_t (&samples_)[kPoints];
    PairBlock pairs_;
    PlacesOnLamp* to_[kTogether] = {};
    std::size_t count_ = 0;
};

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
