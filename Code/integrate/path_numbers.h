// The random numbers of sixteen points.
#pragma once

#include "camera/camera_lanes.h"
#include "integrate/shading_kernel.h"
#include "isa/isa.h"
#include "sample/dimensions.h"
#include "sample/sampler.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

// Draws pairs of numbers for sixteen points, some samples of one dimension after the other, as
// Sampler::stream() numbers them. Lanes draw four samples at a time, of whichever dimensions.
class PairDrawer {
public:
    static constexpr std::size_t kPoints = PointBlock::kPoints;

    // `pixels`, `samples` and the samplers of all draws stay as long as this.
    PairDrawer(const CameraLanes& lanes, const std::uint32_t (&pixels)[kPoints],
               const std::uint32_t (&samples)[kPoints])
        : lanes_(lanes), pixels_(pixels), samples_(samples) {}
    ~PairDrawer() { flush(); }
    PairDrawer(const PairDrawer&) = delete;
    PairDrawer& operator=(const PairDrawer&) = delete;

    // The pairs of `repeats` samples, which are written until the drawer's life ends.
    void draw(const Sampler& sampler, std::uint32_t dimension, std::uint32_t repeats,
              NumberPairs* to) {
        if (!sampler.isInLanes()) {
            for (std::uint32_t s = 0; s < repeats; ++s)
                for (std::size_t i = 0; i < kPoints; ++i) {
                    const Vec2 pair =
                        sampler.get2D(pixels_[i], samples_[i] * repeats + s, dimension);
                    to[s].u[i] = pair.x, to[s].v[i] = pair.y;
                }
            return;
        }
        if (count_ > 0 && (sampler.kind() != sampler_->kind() ||
                           sampler.sampleBits() != sampler_->sampleBits()))
            flush();
        sampler_ = &sampler;
        std::size_t seeds = 0; // where the lamp's first seeds are
        for (std::uint32_t s = 0; s < repeats; ++s) {
            const std::size_t at = count_ * kPoints;
            if (s == 0 || count_ == 0) {
                lanes_.seedsOf(sampler, dimension, std::span<const std::uint32_t>(pixels_),
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
        lanes_.pairsOf(*sampler_, pairs_, count_ * kPoints);
        for (std::size_t k = 0; k < count_; ++k) {
            std::copy_n(pairs_.u + k * kPoints, kPoints, to_[k]->u);
            std::copy_n(pairs_.v + k * kPoints, kPoints, to_[k]->v);
        }
        count_ = 0;
    }

    const CameraLanes& lanes_;
    const std::uint32_t (&pixels_)[kPoints];
    const std::uint32_t (&samples_)[kPoints];
    PairBlock pairs_;
    const Sampler* sampler_ = nullptr; // of the last draw
    NumberPairs* to_[kTogether] = {};
    std::size_t count_ = 0;
};
