// Rays that a block of points sends on where all that bounces is a plain mirror: nobody asks what
// they are inside of, and random numbers are drawn by none of them.
#pragma once

#include "render/waves/bounce_blocks.h"

namespace waves {

inline void mirrorBlock(const Wave& wave, std::size_t b) {
    const PointBatch& points = wave.memory.points;
    const PaintedBlock& painted = points.painted[b];
    if (painted.mirrors == 0) return;
    const std::size_t from = b * PointColumns::kPoints;
    const Rgb* const weights = &points.weight[from];
    const float cutoff = wave.context.cutoff;
    const auto [out, first] = sendFrom(wave, [&](const RayPlaces& to, LeavingRays& leaving) {
        const BounceLanes& lanes = wave.context.bounceLanes;
        if (painted.all == nullptr)
            return lanes.mirror(points.at.block(b), weights, &points.material[from],
                                painted.mirrors, cutoff, to, leaving);
        const AlikePoints all{painted.mirrors, painted.all};
        lanes.bounce(points.at.block(b), weights, {&all, 1}, nullptr, cutoff, to, leaving);
    });
    PathBatch& next = wave.memory.next;
    const auto forEachRay = [&, first = first, rays = out.rays](const auto& fn) {
        std::size_t ray = first;
        for (std::uint32_t rest = rays; rest != 0; rest &= rest - 1) // two bits for each point
            fn(ray++, from + static_cast<std::size_t>(std::countr_zero(rest)) / 2);
    };
    if (out.reflected == PointColumns::kPoints)
        std::copy_n(&points.slot[from], PointColumns::kPoints, &next.sample[first]);
    else
        forEachRay([&](std::size_t ray, std::size_t k) { next.sample[ray] = points.slot[k]; });
    if (wave.context.scene.moves())
        forEachRay([&](std::size_t ray, std::size_t k) {
            next.time[ray] = wave.rays.time[points.ray[k]];
        });
    else
        std::fill_n(next.time.data() + first, out.reflected, wave.rays.time[0]);
}

} // namespace waves
