// Light of a lamp at a point of the wave, before anything is in the way.
#pragma once

#include "render/waves/hidden_point.h"
#include "render/waves/steps.h"
#include "render/waves/wave.h"

inline LitPoint litPoint(const Wave& wave, std::size_t k) {
    const PointBatch& points = wave.memory.points;
    const PointBlock& block = points.at.block(k / PointColumns::kPoints);
    const std::size_t i = k % PointColumns::kPoints;
    const bool isApart = block.isLitApart(i), isCurved = block.isCurved(i);
    const float side = isApart || block.isFront(i) ? 1.0f : -1.0f; // times it is exact
    LitPoint lit{static_cast<std::uint32_t>(k),
                 SurfaceBlock::get(block.p, i),
                 SurfaceBlock::get(isApart ? block.litN : block.n, i),
                 SurfaceBlock::get(block.ng, i) * side,
                 {},
                 {},
                 SurfaceBlock::get(block.toEye, i),
                 block.error[i],
                 block.rayError[i],
                 points.weight[k],
                 points.material[k]};
    if (isCurved) {
        lit.ns = SurfaceBlock::get(block.ns, i) * side;
        lit.lift = SurfaceBlock::get(block.lift, i);
    }
    return lit;
}

// Is the light above the horizon, of the triangle or of the curve that its normals pretend?
inline bool rises(const LitPoint& lit, Vec3 toLight) {
    return dot(lit.ng, toLight) > 0 || (lit.lift != Vec3{} && dot(lit.ns, toLight) > 0);
}

// Number of the lamp's first random place at the hit of ray i.
inline std::uint32_t firstSample(const Lamp& lamp, const Wave& wave, std::size_t i) {
    return wave.chunk.sampleNumber[wave.rays.sample[i]] * static_cast<std::uint32_t>(lamp.samples);
}

// Random place on the lamp for its k-th sample at the hit of ray i.
inline Vec2 placeOn(const Lamp& lamp, int k, const Wave& wave, std::size_t i) {
    return lamp.sampler.get2D(wave.rays.stream[i],
                              firstSample(lamp, wave, i) + static_cast<std::uint32_t>(k),
                              dimension(wave.depth, BounceSlot::LightUv));
}

// What the picture's sample gets of all of a lamp that has a size, if nothing is in between; black
// where there is no closed form, as for highlights.
inline Rgb wholeLight(const Lamp& lamp, const LitPoint& lit) {
    if (!isBlack(lit.material->specular)) return {};
    auto whole = lamp.light.whole(lit.p, lit.n, lit.ng);
    if (!whole && lit.lift != Vec3{}) whole = lamp.light.whole(lit.p, lit.n, lit.ns);
    if (!whole) return {};
    return lit.weight * reflectedLight(*lit.material, lit.n, lit.toEye, whole->toLight) *
           whole->irradiance;
}

// The same where it is known that nothing is in between; else black.
inline Rgb unhiddenLight(const Wave& wave, const Lamp& lamp, const LitPoint& lit) {
    if (!lamp.ball) return {};
    const Rgb whole = wholeLight(lamp, lit);
    if (isBlack(whole)) return {};
    const PointBatch& points = wave.memory.points;
    const PointBlock& block = points.at.block(lit.point / PointColumns::kPoints);
    const std::size_t i = lit.point % PointColumns::kPoints;
    const bool inside = !block.isFront(i) && !block.isLitApart(i);
    const HidingPlace place{lit.p, lit.lift, points.shape[lit.point], inside};
    return mayHide(wave.context.occluders, place, *lamp.ball) ? Rgb{} : whole;
}

// fn(sample, light) for every sample of the lamp that sends light from the point to the eye:
// `light` is what the sample of the picture gets if nothing is in between.
template <bool kSoftLamps, class Fn>
void forEachLampSample(const Wave& wave, const Lamp& lamp, const LitPoint& lit, Fn&& fn) {
    const auto take = [&](const LightSample& sample, float share) {
        if (isBlack(sample.irradiance) || !rises(lit, sample.toLight)) return;
        const Rgb reflected = reflectedLight(*lit.material, lit.n, lit.toEye, sample.toLight);
        const Rgb light = lit.weight * reflected * sample.irradiance * share;
        if (!isBlack(light)) fn(sample, light);
    };
    if constexpr (kSoftLamps)
        if (lamp.isSoft) {
            if (lamp.light.cannotReach(lit.p, lit.n)) return;
            const std::uint32_t ray = wave.memory.points.ray[lit.point];
            for (int s = 0; s < lamp.samples; ++s)
                take(lamp.light.sample(lit.p, placeOn(lamp, s, wave, ray)),
                     1.0f / static_cast<float>(lamp.samples));
            return;
        }
    LightSample sample;
    if (lamp.light.shine(lit.p, lit.n, sample)) take(sample, 1);
}
