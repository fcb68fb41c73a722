// Points of a wave in blocks, as lanes want them, and what lamps in lanes do to them: light that
// arrives, and shadow rays for light that something may hide.
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

// The samples first .. first + count - 1 of a lamp that has a size, for those points of a block.
inline SamplesOnLamp samplesOf(const Wave& wave, const Lamp& lamp, const LitBlock& block,
                               unsigned points, int first, int count) {
    SamplesOnLamp samples;
    samples.count = static_cast<std::size_t>(count), samples.points = points;
    samples.share = 1.0f / static_cast<float>(lamp.samples);
    Sampler::PairSeeds seeds{};
    std::uint32_t stream = 0;
    for (unsigned i = 0; i < static_cast<unsigned>(std::popcount(block.used)); ++i) {
        const std::size_t ray = wave.memory.points.ray[block.point[i]];
        if (i == 0 || wave.rays.stream[ray] != stream) { // else as the last one of its pixel
            stream = wave.rays.stream[ray];
            seeds = lamp.sampler.pairSeeds(stream, dimension(wave.depth, BounceSlot::LightUv));
        }
        samples.index[i] = seeds.index, samples.x[i] = seeds.x, samples.y[i] = seeds.y;
        samples.first[i] = firstSample(lamp, wave, ray) + static_cast<std::uint32_t>(first);
    }
    return samples;
}

// The samples of point i of a block that wait, and their rays.
inline void listWaiting(const Wave& wave, const LitBlock& block, const LitBySamples& by,
                        std::size_t i, std::size_t count) {
    WaveMemory& memory = wave.memory;
    const std::uint32_t k = block.point[i];
    const ShadedPoint& at = memory.points.at[k];
    const Vec3 org = leave(at.surface, at.lit.ng) + at.surface.lift;
    const float time = wave.rays.time[memory.points.ray[k]];
    for (std::size_t s = 0; s < count; ++s) {
        if (!by.isLit(s, i)) continue;
        const std::size_t from = s * LitBlock::kPoints + i;
        const Rgb light{by.light[0][from], by.light[1][from], by.light[2][from]};
        std::uint32_t ray = WaitingLight::kNoRay;
        if (by.isUnsure(s, i)) {
            ray = static_cast<std::uint32_t>(memory.shadowRays.size());
            const Vec3 dir{by.dir[0][from], by.dir[1][from], by.dir[2][from]};
            memory.shadowRays.push({org, dir, 0, by.tMax[from], time}, k, light);
        }
        memory.waiting.push_back({k, ray, light});
    }
}

// forEachLampSample() of such a lamp. A point's many shadow rays make it worth while to look at
// each point for itself, and at each line to the lamp. What has to wait for rays is listed.
template <class ArriveFn>
void shineBySamples(const Wave& wave, const Lamp& lamp, ArriveFn&& arrive) {
    WaveMemory& memory = wave.memory;
    const Occluders& occluders = wave.context.occluders;
    const bool canTell = wave.context.settings.specialise && occluders.canTell();
    constexpr int kMost = LitBySamples::kMost;
    memory.waiting.clear();
    LitBySamples by;
    HiddenPoints hidden;
    for (std::size_t b = 0; b * LitBlock::kPoints < memory.answering.size(); ++b) {
        const LitBlock& block = memory.litBlocks[b];
        if (canTell)
            hidden = lamp.hiddenPoints(occluders, block, *lamp.emission);
        else
            hidden.maybe = block.used;
        const unsigned asked = block.used & ~hidden.surely;
        if (asked == 0) continue;
        by.waiting = 0;
        for (float(&channel)[LitBlock::kPoints] : by.sum)
            std::fill_n(channel, LitBlock::kPoints, 0.0f);
        for (int first = 0; first < lamp.samples; first += kMost) {
            const int some = std::min(kMost, lamp.samples - first);
            lamp.bySamples(*lamp.emission, block, samplesOf(wave, lamp, block, asked, first, some),
                           occluders, hidden, by);
            for (unsigned rest = by.waiting; rest != 0; rest &= rest - 1)
                listWaiting(wave, block, by, static_cast<std::size_t>(std::countr_zero(rest)),
                            static_cast<std::size_t>(some));
        }
        for (unsigned rest = asked; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            arrive(block.point[i], Rgb{by.sum[0][i], by.sum[1][i], by.sum[2][i]});
        }
    }
}

} // namespace waves
