// Points of a wave in blocks, as lanes want them, and what lamps in lanes do to them: light that
// arrives, and shadow rays for light that something may hide.
#pragma once

#include "render/lamp_ray.h"
#include "render/waves/lamp_light.h"

#include <algorithm>
#include <bit>

namespace waves {

inline bool seesLampsFromInside(const ShadedPoint& at) { return !(at.front || at.of->litOutside); }

inline Ray shadowRay(const Lamp& lamp, const ShadedPoint& at, const LightSample& sample,
                     float time) {
    if (lamp.origin) return rayFromLamp(at.surface, at.lit.ng, *lamp.origin, time);
    return {leave(at.surface, at.lit.ng) + at.surface.lift, sample.toLight, 0,
            sample.distance * (1 - 0x1p-20f), time};
}

// In the form that lanes want.
inline void fillBlocks(const Wave& wave) {
    WaveMemory& memory = wave.memory;
    const std::size_t count = memory.answering.size();
    const std::size_t blocks = (count + LitBlock::kPoints - 1) / LitBlock::kPoints;
    if (memory.litBlocks.size() < blocks) memory.litBlocks.resize(blocks);
    for (std::size_t b = 0; b < blocks; ++b) {
        LitBlock& block = memory.litBlocks[b];
        const std::size_t first = b * LitBlock::kPoints;
        const std::size_t size = std::min(count - first, LitBlock::kPoints);
        block.used = (1u << size) - 1;
        block.lifted = block.inside = 0;
        for (unsigned& shiny : block.shiny) shiny = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const std::uint32_t k = memory.answering[first + i];
            const ShadedPoint& at = memory.points.at[k];
            const Material& material = *memory.points.material[k];
            const auto put = [i](float(*to)[LitBlock::kPoints], Vec3 v) {
                to[0][i] = v.x, to[1][i] = v.y, to[2][i] = v.z;
            };
            const auto putLight = [&](float(*to)[LitBlock::kPoints], Rgb c) {
                put(to, {c.r, c.g, c.b});
            };
            put(block.p, at.surface.p), put(block.lift, at.surface.lift);
            put(block.n, at.lit.n), put(block.ng, at.lit.ng);
            putLight(block.weight, memory.points.weight[k]);
            putLight(block.diffuse, material.diffuse);
            block.error[i] = at.surface.error, block.rayError[i] = at.surface.rayError;
            block.point[i] = k;
            block.shape[i] = memory.hits[memory.points.ray[k]].shape;
            const unsigned bit = 1u << i;
            if (seesLampsFromInside(at)) block.inside |= bit;
            if (at.surface.lift != Vec3{}) {
                put(block.ns, at.lit.ns);
                block.lifted |= bit;
            }
            if (!isBlack(material.specular)) {
                put(block.toEye, at.toEye), putLight(block.specular, material.specular);
                block.exponent[i] = material.exponent;
                block.shiny[static_cast<std::size_t>(material.specularModel)] |= bit;
            }
        }
    }
}

// The points of a block that something may hide from the lamp that is looked at.
inline unsigned hiddenByGroup(const WaveMemory& memory, std::size_t block, bool isGrouped) {
    if (!isGrouped) return ~0u;
    const std::size_t first = block * LitBlock::kPoints;
    unsigned points = 0;
    for (std::size_t i = 0; i < LitBlock::kPoints && first + i < memory.groupOf.size(); ++i)
        if (memory.groups[memory.groupOf[first + i]].mayBeHidden) points |= 1u << i;
    return points;
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
