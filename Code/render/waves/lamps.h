// Stage of the wave: light of the lamps that cast shadows, and of others that lanes sum up, lamp
// after lamp: the shadow rays of one lamp to all points of the wave are traced together. Those of a
// point lamp start at the lamp and so are one bundle, however many lamps there are.
#pragma once

#include "render/waves/groups.h"
#include "render/waves/lamp_sums.h"
#include "render/waves/soft_lamps.h"

#include <algorithm>
#include <array>
#include <bit>

namespace waves {

// Which points of a block answer lamps, a bit for each. Rays of no weight are not traced; only
// points that are looked through lose it.
template <bool kSeeThrough> unsigned answeringOf(const PointBatch& points, std::size_t b) {
    const PaintedBlock& painted = points.painted[b];
    if (!kSeeThrough && !painted.isTextured) return painted.answersLamps;
    unsigned answering = 0;
    for (std::size_t i = 0; i < points.sizeOf(b); ++i) {
        const std::size_t k = b * PointColumns::kPoints + i;
        const bool answers = painted.isTextured ? answersLamps(*points.material[k])
                                                : (painted.answersLamps >> i & 1) != 0;
        const auto weight = std::bit_cast<std::array<std::uint32_t, 3>>(points.weight[k]);
        const bool counts =
            !kSeeThrough || (weight[0] | weight[1] | weight[2]) << 1 != 0; // not +-0
        answering |= static_cast<unsigned>(answers & counts) << i;
    }
    return answering;
}

// The points that answer lamps. No branch: nobody could guess what comes behind glass.
template <bool kSeeThrough> void listAnswering(const Wave& wave) {
    WaveMemory& memory = wave.memory;
    const PointBatch& points = memory.points;
    if (memory.answering.size() < points.at.size()) memory.answering.resize(points.at.size());
    std::uint32_t* const to = memory.answering.data();
    std::size_t count = 0;
    for (std::size_t b = 0; b < points.blocks(); ++b) {
        const unsigned answering = answeringOf<kSeeThrough>(points, b);
        const auto first = static_cast<std::uint32_t>(b * PointColumns::kPoints);
        if (answering == (1u << PointColumns::kPoints) - 1) { // as most do
            for (std::uint32_t i = 0; i < PointColumns::kPoints; ++i) to[count + i] = first + i;
            count += PointColumns::kPoints;
            continue;
        }
        for (std::uint32_t i = 0; i < points.sizeOf(b); ++i) {
            to[count] = first + i;
            count += answering >> i & 1;
        }
    }
    memory.answering.resize(count);
}

// Which of the shadow rays are hidden, or, with kSeeThrough, what part of their light arrives.
template <bool kSeeThrough> void askShadowRays(const Wave& wave) {
    const RayBatch& rays = wave.memory.shadowRays;
    if (rays.empty()) return;
    wave.counts.tracedShadow += rays.size();
    if constexpr (kSeeThrough)
        transmitted(wave.context.scene, rays, wave.memory.transmittance);
    else
        wave.context.scene.shapes().occluded(rays.span(), wave.memory.hidden);
}

// What arrives of `light` by such a ray.
template <bool kSeeThrough> Rgb arriving(const WaveMemory& memory, std::size_t ray, Rgb light) {
    if constexpr (kSeeThrough) {
        const Rgb part = memory.transmittance[ray];
        return isBlack(part) ? Rgb{} : light * part; // black hides even what is infinite
    }
    return memory.hidden[ray] == 0 ? light : Rgb{};
}

// fn(point, light) for what arrives of the shadow rays' light.
template <bool kSeeThrough, class ArriveFn>
void traceShadowRays(const Wave& wave, ArriveFn&& arrive) {
    askShadowRays<kSeeThrough>(wave);
    const RayBatch& rays = wave.memory.shadowRays;
    wave.counts.shadow += rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Rgb light = arriving<kSeeThrough>(wave.memory, i, rays.weight[i]);
        if (!isBlack(light)) arrive(rays.sample[i], light);
    }
}

inline void addTo(WaveMemory& memory, std::uint32_t place, Rgb light) {
    auto& sum = memory.lightSums[place / LitBlock::kPoints].sum;
    const std::size_t i = place % LitBlock::kPoints;
    sum[0][i] += light.r, sum[1][i] += light.g, sum[2][i] += light.b;
}

// The same for rays that know their sums in memory.lightSums, and are counted.
template <bool kSeeThrough> void addRays(const Wave& wave) {
    askShadowRays<kSeeThrough>(wave);
    WaveMemory& memory = wave.memory;
    const RayBatch& rays = memory.shadowRays;
    for (std::size_t i = 0; i < rays.size(); ++i)
        addTo(memory, rays.sample[i], arriving<kSeeThrough>(memory, i, rays.weight[i]));
}

// The same for all that waits for them, in memory.lightSums.
template <bool kSeeThrough> void addWaiting(const Wave& wave) {
    askShadowRays<kSeeThrough>(wave);
    WaveMemory& memory = wave.memory;
    for (const auto& [place, ray, light] : memory.waiting) {
        const Rgb here =
            ray == WaitingLight::kNoRay ? light : arriving<kSeeThrough>(memory, ray, light);
        addTo(memory, place, here);
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
        wave.add(wave.slotOf(arrival.point), arrival.light);
}

// Lamps that cast no shadows, where sumsOpenLamps().
inline void addOpenLamps(const Wave& wave) {
    for (const Lamp& lamp : wave.context.openLamps) {
        if (!lamp.bySamples) {
            addLampsInLanes<false>(wave, {&lamp, 1}, false);
            continue;
        }
        shineOpenly(wave, lamp);
        addSums(wave);
    }
}

// forEachLampSample() for all points, one by one, for any lamp.
template <bool kSoftLamps, class ArriveFn>
void shineOneByOne(const Wave& wave, const Lamp& lamp, bool isGrouped, ArriveFn&& arrive) {
    WaveMemory& memory = wave.memory;
    unsigned hidden = 0; // of the block
    for (std::size_t i = 0; i < memory.answering.size(); ++i) {
        const std::uint32_t k = memory.answering[i];
        const std::size_t place = i % LitBlock::kPoints;
        if (place == 0) hidden = hiddenByGroup(memory, i / LitBlock::kPoints, isGrouped);
        const bool mayBeHidden = (hidden >> place & 1) != 0;
        const LitPoint lit = litPoint(wave, k);
        if constexpr (kSoftLamps)
            if (const Rgb whole = unhiddenLight(wave, lamp, lit); !isBlack(whole)) {
                arrive(k, whole);
                continue;
            }
        forEachLampSample<kSoftLamps>(wave, lamp, lit, [&](const LightSample& sample, Rgb light) {
            if (!mayBeHidden) {
                ++wave.counts.shadow;
                return arrive(k, light);
            }
            const float time = wave.rays.time[memory.points.ray[k]];
            memory.shadowRays.push(shadowRay(lamp, lit, sample, time), k, light);
        });
    }
}

} // namespace waves

template <bool kSoftLamps, bool kSeeThrough> void addLamps(const Wave& wave) {
    WaveMemory& memory = wave.memory;
    const PointBatch& points = memory.points;
    const std::vector<Lamp>& lamps = wave.context.shadingLamps;
    const bool sumsOpenLamps = waves::sumsOpenLamps(wave);
    if (lamps.empty() && !sumsOpenLamps) return;
    waves::listAnswering<kSeeThrough>(wave);
    if (memory.answering.empty()) return;

    const bool isInOrder = wave.hasOneRayPerSample() || lamps.size() == 1;
    const auto arrive = [&](std::uint32_t k, Rgb light) {
        if (isInOrder)
            wave.add(wave.slotOf(k), light);
        else
            memory.arrivals.push_back({k, light});
    };
    const auto looksAtGroups = [](const Lamp& lamp) { return lamp.hiddenPoints == nullptr; };
    const bool isGrouped =
        std::any_of(lamps.begin(), lamps.end(), looksAtGroups) && waves::groupPoints(wave);
    if (sumsOpenLamps || std::any_of(lamps.begin(), lamps.end(), [](const Lamp& lamp) {
            return lamp.inLanes || lamp.bySamples;
        }))
        waves::fillBlocks(wave);
    if (sumsOpenLamps) waves::addOpenLamps(wave);
    if (lamps.empty()) return;
    if constexpr (!kSeeThrough)
        if (waves::canSumInLanes(wave)) return waves::addLampsInLanes<true>(wave, lamps, isGrouped);
    memory.arrivals.clear();
    for (const Lamp& lamp : lamps) {
        if (isGrouped) waves::askGroups(wave, lamp);
        memory.shadowRays.clear();
        if (lamp.bySamples) {
            if (waves::shineBySamples(wave, lamp, isGrouped))
                waves::addWaiting<kSeeThrough>(wave);
            else
                waves::addRays<kSeeThrough>(wave);
            if (wave.hasOneRayPerSample())
                waves::addSums(wave);
            else
                waves::forEachSum(wave, arrive);
            continue;
        }
        if constexpr (kSoftLamps)
            if (lamp.isSoft) {
                // They come in any order of points.
                memory.lampLight.assign(points.count, Rgb{});
                const auto add = [&](std::uint32_t k, Rgb light) { memory.lampLight[k] += light; };
                waves::shineOneByOne<true>(wave, lamp, isGrouped, add);
                waves::traceShadowRays<kSeeThrough>(wave, add);
                for (const std::uint32_t k : memory.answering) arrive(k, memory.lampLight[k]);
                continue;
            }
        if (lamp.inLanes)
            waves::shineInLanes(wave, lamp, isGrouped, arrive);
        else
            waves::shineOneByOne<false>(wave, lamp, isGrouped, arrive);
        waves::traceShadowRays<kSeeThrough>(wave, arrive);
    }
    if (!isInOrder) waves::addInOrderOfPoints(wave);
}
