// Light of a lamp at a point of the wave, before anything is in the way.
#pragma once

#include "render/waves/steps.h"
#include "render/waves/wave.h"

inline bool answersLamps(const Material& material) {
    return !isBlack(material.diffuse) || !isBlack(material.specular);
}

// Is the light above the horizon, of the triangle or of the curve that its normals pretend?
inline bool rises(const ShadedPoint& at, Vec3 toLight) {
    return dot(at.lit.ng, toLight) > 0 ||
           (at.surface.lift != Vec3{} && dot(at.lit.ns, toLight) > 0);
}

// Random place on the lamp for its k-th sample at the hit of ray i.
inline Vec2 placeOn(const Lamp& lamp, int k, const Wave& wave, std::size_t i) {
    const SampleId id = wave.chunk.ids[wave.rays.sample[i]];
    const auto samples = static_cast<std::uint32_t>(lamp.samples);
    return lamp.sampler.get2D(wave.rays.stream[i],
                              id.index * samples + static_cast<std::uint32_t>(k),
                              dimension(wave.depth, BounceSlot::LightUv));
}

// fn(sample, light) for every sample of the lamp that sends light from point k to the eye: `light`
// is what the sample of the picture gets if nothing is in between.
template <Steps kSteps, class Fn>
void forEachLampSample(const Wave& wave, const Lamp& lamp, std::size_t k, Fn&& fn) {
    const PointBatch& points = wave.memory.points;
    const ShadedPoint& at = points.at[k];
    if (lamp.light.cannotReach(at.surface.p, at.lit.n)) return;
    const auto take = [&](const LightSample& sample, float share) {
        if (isBlack(sample.irradiance) || !rises(at, sample.toLight)) return;
        const Rgb reflected =
            reflectedLight(*points.material[k], at.lit.n, at.toEye, sample.toLight);
        const Rgb light = points.weight[k] * reflected * sample.irradiance * share;
        if (!isBlack(light)) fn(sample, light);
    };
    if constexpr (kSteps.softLamps)
        if (lamp.isSoft) {
            for (int s = 0; s < lamp.samples; ++s)
                take(lamp.light.sample(at.surface.p, placeOn(lamp, s, wave, points.ray[k])),
                     1.0f / static_cast<float>(lamp.samples));
            return;
        }
    take(lamp.light.centre(at.surface.p), 1);
}
