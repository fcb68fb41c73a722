// What lamps without a size do to points in blocks, as lanes want them: light that arrives, and
// shadow rays for light that something may hide.
#pragma once

#include "render/lamp_ray.h"
#include "render/waves/fill_blocks.h"
#include "render/waves/groups.h"

#include <algorithm>
#include <bit>

namespace waves {

inline Ray shadowRay(const Lamp& lamp, const LitPoint& lit, const LightSample& sample, float time) {
    const Surface surface{.p = lit.p,
                          .ng = {},
                          .ns = {},
                          .uv = {},
                          .error = lit.error,
                          .rayError = lit.rayError,
                          .lift = lit.lift};
    if (lamp.origin) return rayFromLamp(surface, lit.ng, *lamp.origin, time);
    return {leave(surface, lit.ng) + lit.lift, sample.toLight, 0, sample.distance * (1 - 0x1p-20f),
            time};
}

// forEachLampSample() for all points, by the lanes of a kernel: of a lamp that is asked in its
// centre.
template <class ArriveFn>
void shineInLanes(const Wave& wave, const Lamp& lamp, bool isGrouped, ArriveFn&& arrive) {
    WaveMemory& memory = wave.memory;
    LitByLamp by;
    for (std::size_t b = 0; b * LitBlock::kPoints < memory.answering.size(); ++b) {
        const LitBlock& block = memory.litBlocks[b];
        const unsigned hidden = hiddenByGroup(memory, b, isGrouped);
        lamp.inLanes(*lamp.emission, block, hidden, by);
        const auto lightAt = [&](std::size_t i) {
            return Rgb{by.light[0][i], by.light[1][i], by.light[2][i]};
        };
        wave.counts.shadow += static_cast<std::uint64_t>(std::popcount(by.lit & ~hidden));
        for (unsigned rest = by.lit & ~hidden; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            arrive(block.point[i], lightAt(i));
        }
        RayBatch& rays = memory.shadowRays;
        std::size_t to = rays.extend(static_cast<std::size_t>(std::popcount(by.lit & hidden)));
        for (unsigned rest = by.lit & hidden; rest != 0; rest &= rest - 1, ++to) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            rays.org[to] = *lamp.origin;
            rays.dir[to] = {by.dir[0][i], by.dir[1][i], by.dir[2][i]};
            rays.tMin[to] = 0, rays.tMax[to] = by.tMax[i];
            rays.time[to] = wave.rays.time[memory.points.ray[block.point[i]]];
            rays.sample[to] = block.point[i];
            rays.weight[to] = lightAt(i);
        }
    }
}

} // namespace waves
