// Stage of the wave: light of the lamps that cast shadows, lamp after lamp: the shadow rays of one
// lamp to all points of the wave are traced together. Those of a point lamp start at the lamp and
// so are one bundle, however many lamps there are.
#pragma once

#include "render/lamp_ray.h"
#include "render/waves/lamp_light.h"

namespace waves {

inline Ray shadowRay(const Lamp& lamp, const ShadedPoint& at, const LightSample& sample,
                     float time) {
    if (lamp.origin) return rayFromLamp(at.surface, at.lit.ng, *lamp.origin, time);
    return {leave(at.surface, at.lit.ng) + at.surface.lift, sample.toLight, 0,
            sample.distance * (1 - 0x1p-20f), time};
}

// What arrives of the shadow rays' light replaces their weights; black: all is hidden.
template <Steps kSteps> void traceShadowRays(const Wave& wave) {
    WaveMemory& memory = wave.memory;
    RayBatch& rays = memory.shadowRays;
    wave.counts.shadow += rays.size();
    if constexpr (kSteps.seeThrough) {
        transmitted(wave.context.scene, rays, memory.transmittance);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Rgb part = memory.transmittance[i]; // black hides even what is infinite
            rays.weight[i] = isBlack(part) ? part : rays.weight[i] * part;
        }
    } else {
        wave.context.scene.shapes().occluded(rays.span(), memory.hidden);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (memory.hidden[i] != 0) rays.weight[i] = {};
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
    for (LitPoint& lit : memory.litPoints) {
        const std::uint32_t shape = memory.hits[memory.points.ray[lit.point]].shape;
        const ShadedPoint& at = memory.points.at[lit.point];
        const bool inside = !(at.front || at.of->litOutside);
        std::size_t g = 0;
        while (g < memory.groups.size() &&
               (memory.groups[g].shape != shape || memory.groups[g].inside != inside))
            ++g;
        if (g == kMostGroups) return false;
        if (g == memory.groups.size()) memory.groups.push_back({shape, inside, {}});
        memory.groups[g].box.extend(at.surface.p);
        memory.groups[g].box.extend(at.surface.p + at.surface.lift);
        lit.group = static_cast<std::uint32_t>(g);
    }
    return true;
}

} // namespace waves

template <Steps kSteps> void addLamps(const Wave& wave) {
    WaveMemory& memory = wave.memory;
    const PointBatch& points = memory.points;
    memory.litPoints.clear();
    for (std::size_t k = 0; k < points.count; ++k)
        if (answersLamps(*points.material[k]) && !isBlack(points.weight[k]))
            memory.litPoints.push_back(litPoint(wave, k));
    if (memory.litPoints.empty() || wave.context.shadingLamps.empty()) return;

    const bool isInOrder = wave.depth == 0 || wave.context.shadingLamps.size() == 1;
    const auto arrive = [&](std::uint32_t k, Rgb light) {
        if (isInOrder)
            wave.add(wave.rays.sample[points.ray[k]], light);
        else
            memory.arrivals.push_back({k, light});
    };
    const bool isGrouped = waves::groupPoints(wave);
    memory.arrivals.clear();
    for (const Lamp& lamp : wave.context.shadingLamps) {
        if (isGrouped)
            for (PointGroup& group : memory.groups)
                group.mayBeHidden = wave.context.occluders.mayHide(
                    group.box, group.shape, group.inside, lamp.light.sourcesFor(group.box));
        memory.shadowRays.clear();
        for (const LitPoint& lit : memory.litPoints) {
            const std::uint32_t k = lit.point;
            const bool mayBeHidden = !isGrouped || memory.groups[lit.group].mayBeHidden;
            forEachLampSample<kSteps>(wave, lamp, lit, [&](const LightSample& sample, Rgb light) {
                if (!mayBeHidden) return arrive(k, light);
                const float time = wave.rays.time[points.ray[k]];
                memory.shadowRays.push(waves::shadowRay(lamp, points.at[k], sample, time), k,
                                       light);
            });
        }
        if (memory.shadowRays.empty()) continue;
        waves::traceShadowRays<kSteps>(wave);
        const RayBatch& rays = memory.shadowRays;
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (!isBlack(rays.weight[i])) arrive(rays.sample[i], rays.weight[i]);
    }
    if (!isInOrder) waves::addInOrderOfPoints(wave);
}
