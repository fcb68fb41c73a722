// Rays that a block of points sends on where all that bounces is a plain mirror: nobody asks what
// they are inside of, and random numbers are drawn by none of them.
#pragma once

#include "render/waves/bounce_blocks.h"

namespace waves {

// Whole runs of points of one material. Returns how many.
inline std::size_t listMirrors(const PointBatch& points, std::size_t b,
                               std::array<AlikePoints, PointColumns::kPoints>& runs) {
    const std::size_t first = b * PointColumns::kPoints, size = points.sizeOf(b);
    const auto& material = points.at.block(b).material;
    std::size_t count = 0;
    for (std::size_t i = 0; i < size;) {
        const std::size_t begin = i;
        while (++i < size && material[i] == material[begin]) {
        }
        const SceneMaterial& of = points.at.of(first + begin);
        if (of.isLamp || isBlack(of.base.mirror)) continue;
        runs[count++] = {(1u << i) - (1u << begin), &of.base, false};
    }
    return count;
}

inline void mirrorBlock(const Wave& wave, std::size_t b) {
    const PointBatch& points = wave.memory.points;
    std::array<AlikePoints, PointColumns::kPoints> runs;
    const std::size_t count = listMirrors(points, b, runs);
    if (count == 0) return;
    const auto [out, first] = sendFrom(wave, b, std::span(runs).first(count));
    PathBatch& next = wave.memory.next;
    std::size_t to = first, from = b * PointColumns::kPoints;
    for (std::uint32_t rest = out.rays; rest != 0; rest &= rest - 1, ++to) { // two bits for each
        const std::size_t k = from + static_cast<std::size_t>(std::countr_zero(rest)) / 2;
        next.sample[to] = points.slot[k], next.time[to] = wave.rays.time[points.ray[k]];
    }
}

} // namespace waves
