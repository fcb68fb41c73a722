// Stage of the wave: the rays of the next one, in the order of the points that spawn them: straight
// on through what is not opaque, then reflected, then refracted.
#pragma once

#include "render/waves/mirrors.h"
#include "render/waves/steps.h"
#include "render/waves/wave.h"

namespace waves {

inline bool worthTracing(const Wave& wave, Rgb weight) {
    const float most = maxChannel(weight);
    return most > 0 && most >= wave.context.cutoff;
}

inline float iorOf(const Scene& scene, std::uint32_t material) {
    return material == MediumTree::kOutside ? 1.0f : scene.materials()[material].base.ior;
}

inline void goStraight(const Wave& wave, std::size_t k) {
    const ShadedPoint& at = wave.memory.points.at[k];
    const Material& material = *wave.memory.points.material[k];
    if (!(material.opacity < 1)) return;
    const PathBatch& rays = wave.rays;
    const std::size_t i = wave.memory.points.ray[k];
    const Rgb weight = rays.weight[i] * material.filter * (1 - material.opacity);
    if (!worthTracing(wave, weight)) return;
    ++wave.counts.refract;
    wave.memory.next.push({leave(at.surface, -at.eye.ng), rays.dir[i], 0, kInfinityF, rays.time[i]},
                          rays.sample[i], weight, rays.medium[i], rays.stream[i],
                          rays.seesLights[i] != 0);
}

inline void push(const Wave& wave, std::size_t k, const Bounce& ray, Vec3 side,
                 MediumTree::Inside medium, std::uint32_t branch, std::uint64_t& counter) {
    const Rgb weight = wave.memory.points.weight[k] * ray.weight;
    if (!worthTracing(wave, weight)) return;
    ++counter;
    const Material& material = *wave.memory.points.material[k];
    const bool seesLights = showsLamps(material);
    const std::size_t i = wave.memory.points.ray[k];
    const PathBatch& rays = wave.rays;
    wave.memory.next.push(
        {leave(wave.memory.points.at[k].surface, side), ray.dir, 0, kInfinityF, rays.time[i]},
        rays.sample[i], weight, medium, low32(hash(rays.stream[i], branch)), seesLights);
}

inline void mirror(const Wave& wave, std::size_t k) {
    const PointBatch& points = wave.memory.points;
    const ShadedPoint& at = points.at[k];
    push(wave, k, {mirrored(at.toEye, at.eye.n, at.eye.ng), points.material[k]->mirror}, at.eye.ng,
         wave.rays.medium[points.ray[k]], kReflected, wave.counts.reflect);
}

inline void bounce(const Wave& wave, std::size_t k) {
    const Scene& scene = wave.context.scene;
    const PathBatch& rays = wave.rays;
    const ShadedPoint& at = wave.memory.points.at[k];
    const Material& material = *wave.memory.points.material[k];
    const std::size_t i = wave.memory.points.ray[k];
    Vec2 u{0.5f, 0.5f};
    if (material.roughness > 0)
        u = wave.context.sampler.get2D(rays.stream[i], wave.chunk.ids[rays.sample[i]].index,
                                       dimension(wave.depth, BounceSlot::BsdfUv));

    MediumTree& media = wave.memory.media;
    const std::uint32_t number = at.surface.material;
    const MediumTree::Inside before = rays.medium[i];
    const MediumTree::Inside after =
        at.front ? media.enter(before, number) : media.leave(before, number);
    const bool startedInside = !at.front && before == MediumTree::kNothing;
    const float iorHere = startedInside ? material.ior : iorOf(scene, media.top(before));
    const float eta = iorHere / iorOf(scene, media.top(after));

    const Bounces out = bounces(material, at.eye.n, at.eye.ng, at.toEye, eta, u);
    if (out.reflected)
        push(wave, k, *out.reflected, at.eye.ng, before, kReflected, wave.counts.reflect);
    if (out.refracted)
        push(wave, k, *out.refracted, -at.eye.ng, after, kRefracted, wave.counts.refract);
}

} // namespace waves

template <bool kBounces, bool kSeeThrough> void spawnBounces(const Wave& wave) {
    wave.memory.next.clear();
    if (wave.depth >= wave.context.settings.picture.maxDepth) return;
    const PointBatch& points = wave.memory.points;
    for (std::size_t k = 0; k < points.count; ++k) {
        if constexpr (kBounces && !kSeeThrough)
            if (const std::size_t b = k / PointColumns::kPoints;
                k % PointColumns::kPoints == 0 && wave.context.shadeLanes.mirror != nullptr)
                if (const auto mirrors = waves::plainMirrors(wave, b)) {
                    waves::mirrorInLanes(wave, b, *mirrors);
                    k += points.sizeOf(b) - 1;
                    continue;
                }
        const Material& material = *points.material[k];
        if (points.at.of(k).isLamp) continue;
        if constexpr (kSeeThrough) {
            waves::goStraight(wave, k);
            if (isBlack(points.weight[k])) continue;
        }
        if constexpr (kBounces)
            if (!isBlack(material.mirror) || !isBlack(material.transmission)) {
                if (isPlainMirror(material))
                    waves::mirror(wave, k);
                else
                    waves::bounce(wave, k);
            }
    }
}
