// What lamps with a size, and suns without, do to points in blocks, as lanes want them: the sum of
// their samples at each of them.
#pragma once

#include "render/waves/groups.h"

#include <algorithm>
#include <bit>

namespace waves {

// The samples first .. first + count - 1 of the lamp, for those points of a block.
inline SamplesOnLamp samplesOf(const Wave& wave, const Lamp& lamp, const LitBlock& block,
                               unsigned points, int first, int count) {
    SamplesOnLamp samples;
    samples.count = static_cast<std::size_t>(count), samples.points = points;
    samples.share = 1.0f / static_cast<float>(lamp.samples);
    if (!lamp.isSoft) return samples;
    const PointBatch& all = wave.memory.points;
    const auto perPoint = static_cast<std::uint32_t>(lamp.samples);
    const auto size = static_cast<std::size_t>(std::popcount(block.used));
    constexpr std::size_t kPoints = LitBlock::kPoints;
    std::array<std::uint32_t, kPoints> streams{}, numbers{};
    const std::uint32_t firstRay = all.ray[block.point[0]];
    // Points ascend, and so do rays, which at depth 0 are numbered as their samples.
    if (wave.depth == 0 && size == kPoints &&
        all.ray[block.point[kPoints - 1]] - firstRay == kPoints - 1) {
        std::copy_n(&wave.rays.stream[firstRay], kPoints, streams.data());
        std::copy_n(&wave.chunk.sampleNumber[firstRay], kPoints, numbers.data());
    } else {
        for (std::size_t i = 0; i < size; ++i) {
            const std::uint32_t k = block.point[i];
            streams[i] = wave.rays.stream[all.ray[k]];
            numbers[i] = wave.chunk.sampleNumber[all.slot[k]];
        }
    }
    for (std::size_t i = 0; i < kPoints; ++i)
        samples.first[i] = numbers[i] * perPoint + static_cast<std::uint32_t>(first);
    const std::uint32_t place = dimension(wave.depth, BounceSlot::LightUv);
    // The samples of a pixel follow each other.
    if (std::all_of(streams.begin(), streams.begin() + size,
                    [&](std::uint32_t stream) { return stream == streams[0]; })) {
        const Sampler::PairSeeds seeds = lamp.sampler.pairSeeds(streams[0], place);
        std::fill_n(samples.index, size, seeds.index);
        std::fill_n(samples.x, size, seeds.x), std::fill_n(samples.y, size, seeds.y);
    } else {
        lamp.seeds(lamp.sampler.seed(), place, streams, {samples.index, samples.x, samples.y});
    }
    return samples;
}

// The samples of a block's points that wait, point after point, and their rays. `place`: of the
// first one's sum.
inline void listWaiting(const Wave& wave, const LitBlock& block, const LitBySamples& by,
                        std::size_t place, std::size_t count) {
    WaveMemory& memory = wave.memory;
    RayBatch& rays = memory.shadowRays;
    std::size_t lit = 0, unsure = 0;
    for (std::size_t s = 0; s < count; ++s)
        lit += static_cast<std::size_t>(std::popcount(by.lit[s] & by.waiting)),
            unsure += static_cast<std::size_t>(std::popcount(by.unsure[s] & by.waiting));
    std::size_t ray = rays.extend(unsure);
    memory.waiting.resize(memory.waiting.size() + lit);
    WaitingLight* to = memory.waiting.data() + (memory.waiting.size() - lit);
    for (unsigned rest = by.waiting; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const std::uint32_t k = block.point[i];
        // leave()
        const Vec3 off =
            SurfaceBlock::get(block.p, i) + SurfaceBlock::get(block.ng, i) * block.error[i];
        const Vec3 org = off + SurfaceBlock::get(block.lift, i);
        const float time = wave.rays.time[memory.points.ray[k]];
        for (std::size_t s = 0; s < count; ++s) {
            if (!by.isLit(s, i)) continue;
            const std::size_t from = s * LitBlock::kPoints + i;
            const Rgb light{by.light[0][from], by.light[1][from], by.light[2][from]};
            const bool asks = by.isUnsure(s, i);
            *to++ = {static_cast<std::uint32_t>(place + i),
                     asks ? static_cast<std::uint32_t>(ray) : WaitingLight::kNoRay, light};
            if (!asks) continue;
            rays.org[ray] = org;
            rays.dir[ray] = {by.dir[0][from], by.dir[1][from], by.dir[2][from]};
            rays.tMin[ray] = 0, rays.tMax[ray] = by.tMax[from], rays.time[ray] = time;
            rays.sample[ray] = k, rays.weight[ray] = light;
            ++ray;
        }
    }
}

// Room for the rays of a block's samples, which lanes write.
inline void offerPlaces(RayBatch& rays, std::size_t block, std::size_t samples, LitBySamples& by) {
    const std::size_t first = rays.extend((samples + 1) * LitBlock::kPoints);
    by.to = {&rays.org[first], &rays.dir[first], &rays.tMax[first], &rays.sample[first],
             &rays.weight[first]};
    by.rays = 0, by.firstSum = static_cast<std::uint32_t>(block * LitBlock::kPoints);
    rays.shrink(first);
}
// They have been written: the rest of them.
inline void takeRays(const Wave& wave, const LitBlock& block, const LitBySamples& by) {
    RayBatch& rays = wave.memory.shadowRays;
    const std::size_t first = rays.extend(by.rays);
    std::fill_n(rays.tMin.data() + first, by.rays, 0.0f);
    if (!wave.context.scene.moves()) {
        std::fill_n(rays.time.data() + first, by.rays, wave.rays.time[0]);
        return;
    }
    for (std::size_t i = first; i < first + by.rays; ++i) {
        const std::uint32_t k = block.point[rays.sample[i] % LitBlock::kPoints];
        rays.time[i] = wave.rays.time[wave.memory.points.ray[k]];
    }
}

// The sums of a block: what the closed form says of the points that it knows, of others `by`.
inline void sumUp(const WholeLight& whole, const LitBySamples& by, LightSums& sums) {
    std::copy_n(&by.sum[0][0], 3 * LitBlock::kPoints, &sums.sum[0][0]);
    for (unsigned rest = whole.known; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        SurfaceBlock::set(sums.sum, i, SurfaceBlock::get(whole.light, i));
    }
}

// What is known without samples of those points of a block that are `open` to all of the lamp, and
// of `points` that it can't reach.
inline void knowWhole(const Wave& wave, const Lamp& lamp, const LitBlock& block, unsigned points,
                      unsigned open, WholeLight& whole) {
    if (lamp.wholeLight) return lamp.wholeLight(*lamp.emission, block, points, open, whole);
    whole.known = 0;
    for (auto& channel : whole.light) std::fill_n(channel, LitBlock::kPoints, 0.0f);
    for (unsigned rest = points & open; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const Rgb light = wholeLight(lamp, litPoint(wave, block.point[i]));
        if (isBlack(light)) continue;
        SurfaceBlock::set(whole.light, i, {light.r, light.g, light.b});
        whole.known |= 1u << i;
    }
}

// The light of a lamp that casts no shadows, into memory.lightSums.
inline void shineOpenly(const Wave& wave, const Lamp& lamp) {
    WaveMemory& memory = wave.memory;
    const std::size_t blocks =
        (memory.answering.size() + LitBlock::kPoints - 1) / LitBlock::kPoints;
    if (memory.lightSums.size() < blocks) memory.lightSums.resize(blocks);
    LitBySamples by;
    WholeLight whole;
    const HiddenPoints hidden{}; // none
    for (std::size_t b = 0; b < blocks; ++b) {
        const LitBlock& block = memory.litBlocks[b];
        knowWhole(wave, lamp, block, block.used, lamp.asksWhole ? block.used : 0, whole);
        for (auto& channel : by.sum) std::fill_n(channel, LitBlock::kPoints, 0.0f);
        by.waiting = 0;
        const unsigned asked = block.used & ~whole.known;
        constexpr int kMost = LitBySamples::kMost;
        for (int first = 0; first < lamp.samples && asked != 0; first += kMost) {
            const int some = std::min(kMost, lamp.samples - first);
            lamp.bySamples(*lamp.all, block, samplesOf(wave, lamp, block, asked, first, some),
                           wave.context.occluders, hidden, by);
        }
        sumUp(whole, by, memory.lightSums[b]);
    }
}

// The light of the lamp at all points that answer lamps, into memory.lightSums. What has to wait
// for rays is listed. A round lamp's many shadow rays make it worth while to look at each point for
// itself, and at each line to the lamp; of others groups of points are asked about.
// Returns whether it was known for each point what may hide it: then some samples wait; else the
// rays know the sum that they belong to.
inline bool shineBySamples(const Wave& wave, const Lamp& lamp, bool isGrouped) {
    WaveMemory& memory = wave.memory;
    const Occluders& occluders = wave.context.occluders;
    const bool isRound = lamp.hiddenPoints != nullptr;
    const bool canTell = isRound && wave.context.settings.specialise && occluders.canTell();
    constexpr int kMost = LitBySamples::kMost;
    constexpr std::size_t kPoints = LitBlock::kPoints;
    const std::size_t blocks = (memory.answering.size() + kPoints - 1) / kPoints;
    if (memory.lightSums.size() < blocks) memory.lightSums.resize(blocks);
    memory.waiting.clear();
    LitBySamples by;
    WholeLight whole;
    HiddenPoints hidden;
    for (std::size_t b = 0; b < blocks; ++b) {
        const LitBlock& block = memory.litBlocks[b];
        auto& sum = memory.lightSums[b].sum;
        hidden.maybe = block.used;
        if (canTell || lamp.ball)
            hidden = lamp.hiddenPoints(occluders, block, lamp.emission->ball());
        if (!canTell) hidden.surely = 0;
        knowWhole(wave, lamp, block, block.used & ~hidden.surely, lamp.ball ? ~hidden.maybe : 0,
                  whole);
        wave.counts.shadow += static_cast<std::uint64_t>(lamp.samples) *
                              static_cast<std::uint64_t>(std::popcount(hidden.surely & block.used));
        if ((whole.known | hidden.surely) == block.used) {
            std::copy_n(&whole.light[0][0], 3 * kPoints, &sum[0][0]);
            continue;
        }
        if (!canTell) hidden.areShapesKnown = false, hidden.maybe = block.used;
        if (!isRound) hidden.maybe &= hiddenByGroup(memory, b, isGrouped);
        for (auto& channel : by.sum) std::fill_n(channel, kPoints, 0.0f);
        by.waiting = 0;
        const unsigned asked = block.used & ~hidden.surely & ~whole.known;
        for (int first = 0; first < lamp.samples && asked != 0; first += kMost) {
            const int some = std::min(kMost, lamp.samples - first);
            if (!canTell) offerPlaces(memory.shadowRays, b, static_cast<std::size_t>(some), by);
            lamp.bySamples(*lamp.all, block, samplesOf(wave, lamp, block, asked, first, some),
                           occluders, hidden, by);
            wave.counts.shadow += by.shining;
            if (!canTell) takeRays(wave, block, by);
            if (by.waiting != 0)
                listWaiting(wave, block, by, b * kPoints, static_cast<std::size_t>(some));
        }
        sumUp(whole, by, memory.lightSums[b]);
    }
    return canTell;
}

} // namespace waves
