// Light of point lamps where every sample has one point: the sums of a block's points stay together
// while one lamp after the other adds to them.
#pragma once

#include "render/waves/lit_blocks.h"

#include <algorithm>
#include <bit>

namespace waves {

inline bool canSumInLanes(const Wave& wave) {
    const std::vector<Lamp>& lamps = wave.context.shadingLamps;
    return wave.hasOneRayPerSample() && wave.context.shadeLanes.add != nullptr &&
           std::all_of(lamps.begin(), lamps.end(),
                       [](const Lamp& lamp) { return lamp.inLanes != nullptr; });
}

// Which groups of points something may hide from a lamp.
inline void askGroups(const Wave& wave, const Lamp& lamp) {
    for (PointGroup& group : wave.memory.groups)
        group.mayBeHidden = wave.context.occluders.mayHide(group.box, group.shape, group.inside,
                                                           lamp.light.sourcesFor(group.box));
}

// fn(sample's radiance, block, place) for all points that answer lamps.
template <class Fn> void forEachSum(const Wave& wave, Fn&& fn) {
    const std::vector<std::uint32_t>& answering = wave.memory.answering;
    for (std::size_t i = 0; i < answering.size(); ++i)
        fn(wave.chunk.radiance[wave.slotOf(answering[i])],
           wave.memory.lightSums[i / LitBlock::kPoints].sum, i % LitBlock::kPoints);
}

// Shadow rays for the points of a block, from the lamp.
inline void pushLampRays(const Wave& wave, const Lamp& lamp, const LitBlock& block,
                         const LitByLamp& by, unsigned points) {
    LampRays& batch = wave.memory.lampRays;
    RayBatch& rays = batch.rays;
    std::size_t to = rays.extend(static_cast<std::size_t>(std::popcount(points)));
    const bool moves = wave.context.scene.moves();
    for (; batch.ready < rays.size(); ++batch.ready) {
        rays.tMin[batch.ready] = 0;
        rays.time[batch.ready] = wave.rays.time[0];
    }
    const Vec3 origin = *lamp.origin;
    for (; points != 0; points &= points - 1, ++to) {
        const auto i = static_cast<std::size_t>(std::countr_zero(points));
        rays.org[to] = origin;
        rays.dir[to] = SurfaceBlock::get(by.dir, i);
        rays.tMax[to] = by.tMax[i];
        if (moves) rays.time[to] = wave.rays.time[wave.memory.points.ray[block.point[i]]];
    }
}

inline void addLampsInLanes(const Wave& wave, bool isGrouped) {
    WaveMemory& memory = wave.memory;
    const std::size_t blocks =
        (memory.answering.size() + LitBlock::kPoints - 1) / LitBlock::kPoints;
    if (memory.byLamp.size() < blocks) memory.byLamp.resize(blocks);
    if (memory.lightSums.size() < blocks) memory.lightSums.resize(blocks);
    forEachSum(wave, [](Rgb& radiance, SurfaceBlock::Lane(&sum)[3], std::size_t i) {
        SurfaceBlock::set(sum, i, {radiance.r, radiance.g, radiance.b});
    });
    RayBatch& rays = memory.lampRays.rays;
    for (const Lamp& lamp : wave.context.shadingLamps) {
        if (isGrouped) askGroups(wave, lamp);
        rays.clear();
        for (std::size_t b = 0; b < blocks; ++b) {
            const unsigned hidden = hiddenByGroup(memory, b, isGrouped);
            LitByLamp& by = memory.byLamp[b];
            lamp.inLanes(*lamp.emission, memory.litBlocks[b], hidden, by);
            pushLampRays(wave, lamp, memory.litBlocks[b], by, by.lit & hidden);
        }
        wave.counts.shadow += rays.size();
        if (!rays.empty()) wave.context.scene.shapes().occluded(rays.span(), memory.hidden);
        std::size_t ray = 0;
        for (std::size_t b = 0; b < blocks; ++b) {
            const LitByLamp& by = memory.byLamp[b];
            unsigned seen = by.lit;
            for (unsigned rest = by.lit & hiddenByGroup(memory, b, isGrouped); rest != 0;
                 rest &= rest - 1)
                seen &= ~(unsigned{memory.hidden[ray++] != 0} << std::countr_zero(rest));
            if (seen != 0) wave.context.shadeLanes.add(by, seen, memory.lightSums[b]);
        }
    }
    forEachSum(wave, [](Rgb& radiance, const SurfaceBlock::Lane(&sum)[3], std::size_t i) {
        radiance = {sum[0][i], sum[1][i], sum[2][i]};
    });
}

} // namespace waves
