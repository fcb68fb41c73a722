// Rays that a block of points sends on where all that bounces is a plain mirror: nobody asks what
// they are inside of, and random numbers are drawn by none of them.
#pragma once

#include "render/waves/bounce_blocks.h"

namespace waves {

// Runs of mirrors of one material. Returns how many.
inline std::size_t listMirrors(const PointBatch& points, std::size_t b,
                               std::array<AlikePoints, PointColumns::kPoints>& runs) {
    const auto& material = points.at.block(b).material;
    std::size_t count = 0;
    for (unsigned rest = points.painted[b].mirrors; rest != 0;) {
        const auto begin = static_cast<std::size_t>(std::countr_zero(rest));
        std::size_t end = begin + 1;
        while ((rest >> end & 1) != 0 && material[end] == material[begin]) ++end;
        const unsigned run = (1u << end) - (1u << begin);
        runs[count++] = {run, &points.at.of(b * PointColumns::kPoints + begin).base, false};
        rest &= ~run;
    }
    return count;
}

inline void mirrorBlock(const Wave& wave, std::size_t b) {
    const PointBatch& points = wave.memory.points;
    if (points.painted[b].mirrors == 0) return;
    std::array<AlikePoints, PointColumns::kPoints> runs;
    const std::size_t count = listMirrors(points, b, runs);
    const auto [out, first] = sendFrom(wave, b, std::span(runs).first(count));
    PathBatch& next = wave.memory.next;
    const std::size_t from = b * PointColumns::kPoints;
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
