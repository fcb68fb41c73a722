// Stage of the wave: light of the lamps that cast shadows, lamp after lamp: the shadow rays of one
// lamp to all points of the wave are traced together. Those of a point lamp start at the lamp and
// so are one bundle, however many lamps there are.
#pragma once

#include "render/lamp_ray.h"
#include "render/waves/lamp_light.h"

#include <algorithm>
#include <bit>

namespace waves {

inline Ray shadowRay(const Lamp& lamp, const ShadedPoint& at, const LightSample& sample,
                     float time) {
    if (lamp.origin) return rayFromLamp(at.surface, at.lit.ng, *lamp.origin, time);
    return {leave(at.surface, at.lit.ng) + at.surface.lift, sample.toLight, 0,
            sample.distance * (1 - 0x1p-20f), time};
}

// fn(point, light) for what arrives of the shadow rays' light.
template <bool kSeeThrough, class ArriveFn>
void traceShadowRays(const Wave& wave, ArriveFn&& arrive) {
    WaveMemory& memory = wave.memory;
    const RayBatch& rays = memory.shadowRays;
    if (rays.empty()) return;
    wave.counts.shadow += rays.size();
    if constexpr (kSeeThrough) {
        transmitted(wave.context.scene, rays, memory.transmittance);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Rgb part = memory.transmittance[i];
            if (isBlack(part)) continue; // hides even what is infinite
            const Rgb light = rays.weight[i] * part;
            if (!isBlack(light)) arrive(rays.sample[i], light);
        }
    } else {
        wave.context.scene.shapes().occluded(rays.span(), memory.hidden);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (memory.hidden[i] == 0) arrive(rays.sample[i], rays.weight[i]);
    }
}

// Sums run over the rays of a wave in their order, and for each over the lamps. After the first
// wave a sample may have several rays: then what came lamp by lamp is sorted by points first.
inline void addInOrderOfPoints(const Wave& wave) {
    WaveMemory& memory = wave.memory;
    std::vector<std::uint32_t>& next = memory.arrivalStarts; // by point: where its next one goes
    next.assign(memory.points.count + 1, 0);
    for (const Arrival& arrival : memory.arrivals) ++next[arrival.point + 1];
    for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
    memory.arrivalsInOrder.resize(memory.arrivals.size());
    for (const Arrival& arrival : memory.arrivals)
        memory.arrivalsInOrder[next[arrival.point]++] = arrival;
    for (const Arrival& arrival : memory.arrivalsInOrder)
        wave.add(wave.rays.sample[memory.points.ray[arrival.point]], arrival.light);
}

// Divides the points that answer lamps by the shape that they are on. False when there is nothing
// to win: points of later waves are far apart, those of many shapes have many boxes.
inline bool groupPoints(const Wave& wave) {
    constexpr std::size_t kMostGroups = 4;
    const IntegratorContext& context = wave.context;
    WaveMemory& memory = wave.memory;
    if (wave.depth > 0 || !context.settings.specialise || !context.occluders.canTell())
        return false;
    memory.groups.clear();
    memory.groupOf.clear();
    for (const std::uint32_t k : memory.answering) {
        const std::uint32_t shape = memory.hits[memory.points.ray[k]].shape;
        const ShadedPoint& at = memory.points.at[k];
        const bool inside = !(at.front || at.of->litOutside);
        std::size_t g = 0;
        while (g < memory.groups.size() &&
               (memory.groups[g].shape != shape || memory.groups[g].inside != inside))
            ++g;
        if (g == kMostGroups) return false;
        if (g == memory.groups.size()) memory.groups.push_back({shape, inside, {}});
        memory.groups[g].box.extend(at.surface.p);
        memory.groups[g].box.extend(at.surface.p + at.surface.lift);
        memory.groupOf.push_back(static_cast<std::uint8_t>(g));
    }
    return true;
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
        block.lifted = 0;
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
            const unsigned bit = 1u << i;
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
inline unsigned mayBeHidden(const WaveMemory& memory, std::size_t block, bool isGrouped) {
    if (!isGrouped) return ~0u;
    const std::size_t first = block * LitBlock::kPoints;
    unsigned points = 0;
    for (std::size_t i = 0; i < LitBlock::kPoints && first + i < memory.groupOf.size(); ++i)
        if (memory.groups[memory.groupOf[first + i]].mayBeHidden) points |= 1u << i;
    return points;
}

// forEachLampSample() for all points, by the lanes of a kernel.
template <class ArriveFn>
void shineInLanes(const Wave& wave, const Lamp& lamp, bool isGrouped, ArriveFn&& arrive) {
    WaveMemory& memory = wave.memory;
    LitByLamp by;
    for (std::size_t b = 0; b * LitBlock::kPoints < memory.answering.size(); ++b) {
        const LitBlock& block = memory.litBlocks[b];
        const unsigned hidden = mayBeHidden(memory, b, isGrouped);
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

// The same point by point, for any lamp.
template <bool kSoftLamps, class ArriveFn>
void shineOneByOne(const Wave& wave, const Lamp& lamp, bool isGrouped, ArriveFn&& arrive) {
    WaveMemory& memory = wave.memory;
    for (std::size_t i = 0; i < memory.answering.size(); ++i) {
        const std::uint32_t k = memory.answering[i];
        const bool mayBeHidden = !isGrouped || memory.groups[memory.groupOf[i]].mayBeHidden;
        const LitPoint lit = litPoint(wave, k);
        forEachLampSample<kSoftLamps>(wave, lamp, lit, [&](const LightSample& sample, Rgb light) {
            if (!mayBeHidden) return arrive(k, light);
            const float time = wave.rays.time[memory.points.ray[k]];
            memory.shadowRays.push(shadowRay(lamp, memory.points.at[k], sample, time), k, light);
        });
    }
}

} // namespace waves

template <bool kSoftLamps, bool kSeeThrough> void addLamps(const Wave& wave) {
    WaveMemory& memory = wave.memory;
    const PointBatch& points = memory.points;
    const std::vector<Lamp>& lamps = wave.context.shadingLamps;
    if (lamps.empty()) return;
    memory.answering.clear();
    for (std::size_t k = 0; k < points.count; ++k)
        if (answersLamps(*points.material[k]) && !isBlack(points.weight[k]))
            memory.answering.push_back(static_cast<std::uint32_t>(k));
    if (memory.answering.empty()) return;

    const bool isInOrder = wave.depth == 0 || lamps.size() == 1;
    const auto arrive = [&](std::uint32_t k, Rgb light) {
        if (isInOrder)
            wave.add(wave.rays.sample[points.ray[k]], light);
        else
            memory.arrivals.push_back({k, light});
    };
    const bool isGrouped = waves::groupPoints(wave);
    if (std::any_of(lamps.begin(), lamps.end(), [](const Lamp& l) { return l.inLanes; }))
        waves::fillBlocks(wave);
    memory.arrivals.clear();
    for (const Lamp& lamp : lamps) {
        if (isGrouped)
            for (PointGroup& group : memory.groups)
                group.mayBeHidden = wave.context.occluders.mayHide(
                    group.box, group.shape, group.inside, lamp.light.sourcesFor(group.box));
        memory.shadowRays.clear();
        if (lamp.inLanes)
            waves::shineInLanes(wave, lamp, isGrouped, arrive);
        else
            waves::shineOneByOne<kSoftLamps>(wave, lamp, isGrouped, arrive);
        waves::traceShadowRays<kSeeThrough>(wave, arrive);
    }
    if (!isInOrder) waves::addInOrderOfPoints(wave);
}
