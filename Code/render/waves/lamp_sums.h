// Light of point lamps where every sample has one point: the sums of a block's points stay together
// while one lamp after the other adds to them.
#pragma once

#include "render/waves/lit_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

namespace waves {

inline bool canSumInLanes(const Wave& wave) {
    const std::vector<Lamp>& lamps = wave.context.shadingLamps;
    return wave.hasOneRayPerSample() && wave.context.shadeLanes.add != nullptr &&
           std::all_of(lamps.begin(), lamps.end(),
                       [](const Lamp& lamp) { return lamp.inLanes != nullptr; });
}

// Lamps that cast no shadows are summed up by lanes, too, before the others; else glow.h adds them.
inline bool sumsOpenLamps(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const auto isInLanes = [](const Lamp& lamp) { return lamp.inLanes || lamp.bySamples; };
    return !context.openLamps.empty() && !context.steps.lampBodies && !context.steps.seeThrough &&
           wave.hasOneRayPerSample() && context.shadeLanes.add != nullptr &&
           std::all_of(context.openLamps.begin(), context.openLamps.end(), isInLanes);
}

using LampOrigins = std::array<Vec3, LitBlock::kPoints>;

// fn(points, their sums) for all blocks of points that answer lamps.
template <class Fn> void forEachSums(const Wave& wave, const Fn& fn) {
    LightSums* block = wave.memory.lightSums.data();
    for (std::span<const std::uint32_t> rest(wave.memory.answering); !rest.empty(); ++block) {
        const std::size_t count = std::min(rest.size(), LitBlock::kPoints);
        fn(rest.first(count), *block);
        rest = rest.subspan(count);
    }
}
// fn(point, its sum) for all of them.
template <class Fn> void forEachSum(const Wave& wave, const Fn& fn) {
    forEachSums(wave, [&](std::span<const std::uint32_t> points, const LightSums& block) {
        const auto& sum = block.sum;
        for (std::size_t i = 0; i < points.size(); ++i)
            fn(points[i], Rgb{sum[0][i], sum[1][i], sum[2][i]});
    });
}

// Where the light of a block's points goes, if their samples follow each other: they ascend.
inline Rgb* radianceInARow(const Wave& wave, std::span<const std::uint32_t> points) {
    const std::vector<std::uint32_t>& slot = wave.memory.points.slot;
    const std::uint32_t first = slot[points.front()];
    const bool isRow =
        points.size() == LitBlock::kPoints && slot[points.back()] - first == LitBlock::kPoints - 1;
    return isRow ? &wave.chunk.radiance[first] : nullptr;
}
inline void takeRadiance(const Wave& wave) {
    forEachSums(wave, [&](std::span<const std::uint32_t> points, LightSums& block) {
        if (const Rgb* const row = radianceInARow(wave, points))
            return wave.context.shadeLanes.take(row, block);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Rgb& radiance = wave.chunk.radiance[wave.slotOf(points[i])];
            SurfaceBlock::set(block.sum, i, {radiance.r, radiance.g, radiance.b});
        }
    });
}
inline void giveRadiance(const Wave& wave) {
    forEachSums(wave, [&](std::span<const std::uint32_t> points, const LightSums& block) {
        if (Rgb* const row = radianceInARow(wave, points))
            return wave.context.shadeLanes.give(block, row);
        const auto& sum = block.sum;
        for (std::size_t i = 0; i < points.size(); ++i)
            wave.chunk.radiance[wave.slotOf(points[i])] = {sum[0][i], sum[1][i], sum[2][i]};
    });
}

// To the radiance of samples that have one point each.
inline void addSums(const Wave& wave) {
    forEachSums(wave, [&](std::span<const std::uint32_t> points, const LightSums& block) {
        if (Rgb* const row = radianceInARow(wave, points); row && wave.context.shadeLanes.addRow)
            return wave.context.shadeLanes.addRow(block, row);
        const auto& sum = block.sum;
        for (std::size_t i = 0; i < points.size(); ++i)
            wave.add(wave.slotOf(points[i]), {sum[0][i], sum[1][i], sum[2][i]});
    });
}

// Shadow rays for the points of a block, from the lamp whose place, sixteen times, is `origins`.
inline void pushLampRays(const Wave& wave, const LampOrigins& origins, const LitBlock& block,
                         const LitByLamp& by, unsigned points) {
    if (points == 0) return;
    LampRays& batch = wave.memory.lampRays;
    RayBatch& rays = batch.rays;
    const std::size_t to = rays.extend(LitBlock::kPoints); // lanes write whole registers
    std::copy(origins.begin(), origins.end(), rays.org.begin() + static_cast<std::ptrdiff_t>(to));
    wave.context.shadeLanes.aim(by, points, {nullptr, &rays.dir[to], &rays.tMax[to], nullptr});
    for (; batch.ready < rays.size(); ++batch.ready) {
        rays.tMin[batch.ready] = 0;
        rays.time[batch.ready] = wave.rays.time[0];
    }
    rays.shrink(to + static_cast<std::size_t>(std::popcount(points)));
    if (!wave.context.scene.moves()) return;
    for (std::size_t ray = to; points != 0; points &= points - 1, ++ray)
        rays.time[ray] =
            wave.rays.time[wave.memory.points.ray[block.point[std::countr_zero(points)]]];
}

// kShadows: the lamps cast some.
template <bool kShadows>
void addLampsInLanes(const Wave& wave, std::span<const Lamp> lamps, bool isGrouped) {
    WaveMemory& memory = wave.memory;
    const std::size_t blocks =
        (memory.answering.size() + LitBlock::kPoints - 1) / LitBlock::kPoints;
    if (memory.byLamp.size() < blocks) memory.byLamp.resize(blocks);
    if (memory.lightSums.size() < blocks) memory.lightSums.resize(blocks);
    takeRadiance(wave);
    RayBatch& rays = memory.lampRays.rays;
    for (const Lamp& lamp : lamps) {
        if (isGrouped) askGroups(wave, lamp);
        rays.clear();
        LampOrigins origins;
        origins.fill(*lamp.origin);
        for (std::size_t b = 0; b < blocks; ++b) {
            const unsigned hidden = kShadows ? hiddenByGroup(memory, b, isGrouped) : 0;
            LitByLamp& by = memory.byLamp[b];
            lamp.inLanes(*lamp.emission, memory.litBlocks[b], hidden, by);
            by.unsure = by.lit & hidden;
            if (kShadows) wave.counts.shadow += static_cast<std::uint64_t>(std::popcount(by.lit));
        }
        if (lamp.map)
            lamp.askMap(*lamp.map, std::span(memory.litBlocks).first(blocks),
                        std::span(memory.byLamp).first(blocks));
        for (std::size_t b = 0; b < blocks; ++b)
            pushLampRays(wave, origins, memory.litBlocks[b], memory.byLamp[b],
                         memory.byLamp[b].unsure);
        wave.counts.tracedShadow += rays.size();
        if (!rays.empty()) wave.context.scene.shapes().occluded(rays.span(), memory.hidden);
        memory.hidden.resize(rays.size() + LitBlock::kPoints); // lanes look at whole registers
        std::size_t ray = 0;
        for (std::size_t b = 0; b < blocks; ++b) {
            const LitByLamp& by = memory.byLamp[b];
            wave.context.shadeLanes.add(by, by.unsure, &memory.hidden[ray], memory.lightSums[b]);
            ray += static_cast<std::size_t>(std::popcount(by.unsure));
        }
    }
    giveRadiance(wave);
}

} // namespace waves
