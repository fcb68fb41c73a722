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

// The samples first .. first + count - 1 of a lamp that has a size, for the points of a block.
inline SamplesOnLamp samplesOf(const Wave& wave, const Lamp& lamp, const LitBlock& block, int first,
                               int count) {
    SamplesOnLamp samples;
    samples.count = static_cast<std::size_t>(count);
    samples.share = 1.0f / static_cast<float>(lamp.samples);
    for (unsigned rest = block.used; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const std::size_t ray = wave.memory.points.ray[block.point[i]];
        const Sampler::PairSeeds seeds = lamp.sampler.pairSeeds(
            wave.rays.stream[ray], dimension(wave.depth, BounceSlot::LightUv));
        samples.index[i] = seeds.index, samples.x[i] = seeds.x, samples.y[i] = seeds.y;
        samples.first[i] = firstSample(lamp, wave, ray) + static_cast<std::uint32_t>(first);
    }
    return samples;
}

// What a lamp's samples s of one point do: fn(s, light) for those that are lit.
template <class Fn>
void forEachLit(const LitBySamples& by, std::size_t i, std::size_t count, Fn&& fn) {
    for (std::size_t s = i * count; s < (i + 1) * count; ++s)
        if (by.isLit(s)) fn(s, Rgb{by.light[0][s], by.light[1][s], by.light[2][s]});
}

inline void pushShadowRays(const Wave& wave, std::uint32_t k, const LitBySamples& by, std::size_t i,
                           std::size_t count) {
    RayBatch& rays = wave.memory.shadowRays;
    const ShadedPoint& at = wave.memory.points.at[k];
    const Vec3 org = leave(at.surface, at.lit.ng) + at.surface.lift;
    const float time = wave.rays.time[wave.memory.points.ray[k]];
    std::size_t lit = 0;
    for (std::size_t s = i * count; s < (i + 1) * count; ++s) lit += by.isLit(s);
    std::size_t to = rays.extend(lit);
    forEachLit(by, i, count, [&](std::size_t s, Rgb light) {
        rays.org[to] = org, rays.dir[to] = {by.dir[0][s], by.dir[1][s], by.dir[2][s]};
        rays.tMin[to] = 0, rays.tMax[to] = by.tMax[s], rays.time[to] = time;
        rays.sample[to] = k, rays.weight[to] = light;
        ++to;
    });
}

// forEachLampSample() of such a lamp. A point's many shadow rays make it worth while to look at
// each point for itself.
inline void shineBySamples(const Wave& wave, const Lamp& lamp, bool isInOrder) {
    WaveMemory& memory = wave.memory;
    const Occluders& occluders = wave.context.occluders;
    const bool canTell = wave.context.settings.specialise && occluders.canTell();
    constexpr int kMost = LitBySamples::kMost;
    LitBySamples by;
    for (std::size_t b = 0; b * LitBlock::kPoints < memory.answering.size(); ++b) {
        const LitBlock& block = memory.litBlocks[b];
        const unsigned hidden = canTell ? lamp.mayBeHidden(occluders, block, *lamp.emission) : ~0u;
        for (int first = 0; first < lamp.samples; first += kMost) {
            const int some = std::min(kMost, lamp.samples - first);
            const auto count = static_cast<std::size_t>(some);
            lamp.bySamples(*lamp.emission, block, samplesOf(wave, lamp, block, first, some), by);
            for (unsigned rest = block.used; rest != 0; rest &= rest - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(rest));
                const std::uint32_t k = block.point[i];
                if ((hidden >> i & 1) != 0) {
                    pushShadowRays(wave, k, by, i, count);
                } else if (isInOrder) {
                    Rgb sum = wave.chunk.radiance[wave.slotOf(k)];
                    forEachLit(by, i, count, [&](std::size_t, Rgb light) { sum += light; });
                    wave.chunk.radiance[wave.slotOf(k)] = sum;
                } else {
                    forEachLit(by, i, count, [&](std::size_t, Rgb light) {
                        memory.arrivals.push_back({k, light});
                    });
                }
            }
        }
    }
}

} // namespace waves
