// Rays that one point sends on: straight through what is not opaque, reflected, refracted.
#pragma once

#include "render/waves/wave.h"
#include "sample/hash.h"

namespace waves {

// Branches of the tree of rays: numbers for Sampler.
inline constexpr std::uint32_t kReflected = 1, kRefracted = 2;
constexpr std::uint32_t streamOf(std::uint32_t parent, std::uint32_t branch) {
    return low32(hash(parent, branch));
}

// A rough surface's highlight has counted the lamps; a sharp mirror shows their bodies.
inline bool showsLamps(const Material& material) {
    return material.roughness <= 0 || isBlack(material.specular);
}

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
                          rays.seesLights[i]);
}

inline void push(const Wave& wave, std::size_t k, const Bounce& ray, Vec3 side,
                 MediumTree::Inside medium, std::uint32_t branch, std::uint64_t& counter) {
    const Rgb weight = wave.memory.points.weight[k] * ray.weight;
    if (!worthTracing(wave, weight)) return;
    ++counter;
    const Material& material = *wave.memory.points.material[k];
    const std::uint8_t seesLights = showsLamps(material) ? PathBatch::kSeesAsReflection : 0;
    const std::size_t i = wave.memory.points.ray[k];
    const PathBatch& rays = wave.rays;
    wave.memory.next.push(
        {leave(wave.memory.points.at[k].surface, side), ray.dir, 0, kInfinityF, rays.time[i]},
        rays.sample[i], weight, medium, streamOf(rays.stream[i], branch), seesLights);
}

inline void mirror(const Wave& wave, std::size_t k) {
    const PointBatch& points = wave.memory.points;
    const ShadedPoint& at = points.at[k];
    push(wave, k, {mirrored(at.toEye, at.eye.n, at.eye.ng), points.material[k]->mirror}, at.eye.ng,
         wave.rays.medium[points.ray[k]], kReflected, wave.counts.reflect);
}

// What a ray is inside of on both sides of a point, and the ior on the eye's side over that on the
// other side.
struct Boundary {
    MediumTree::Inside before = MediumTree::kNothing, after = MediumTree::kNothing;
    float eta = 1;
};
[[gnu::always_inline]] inline Boundary boundaryAt(const Wave& wave, std::size_t k) {
    const Scene& scene = wave.context.scene;
    const ShadedPoint& at = wave.memory.points.at[k];
    MediumTree& media = wave.memory.media;
    const std::uint32_t number = at.surface.material;
    const MediumTree::Inside before = wave.rays.medium[wave.memory.points.ray[k]];
    const MediumTree::Inside after =
        at.front ? media.enter(before, number) : media.leave(before, number);
    const bool startedInside = !at.front && before == MediumTree::kNothing;
    const float iorHere =
        startedInside ? wave.memory.points.material[k]->ior : iorOf(scene, media.top(before));
    return {before, after, iorHere / iorOf(scene, media.top(after))};
}

inline void bounce(const Wave& wave, std::size_t k) {
    const PathBatch& rays = wave.rays;
    const ShadedPoint& at = wave.memory.points.at[k];
    const Material& material = *wave.memory.points.material[k];
    const std::size_t i = wave.memory.points.ray[k];
    Vec2 u{0.5f, 0.5f};
    if (material.roughness > 0)
        u = wave.context.sampler.get2D(rays.stream[i], wave.chunk.sampleNumber[rays.sample[i]],
                                       dimension(wave.depth, BounceSlot::BsdfUv));

    const auto [before, after, eta] = boundaryAt(wave, k);
    const Bounces out = bounces(material, at.eye.n, at.eye.ng, at.toEye, eta, u);
    if (out.reflected)
        push(wave, k, *out.reflected, at.eye.ng, before, kReflected, wave.counts.reflect);
    if (out.refracted)
        push(wave, k, *out.refracted, -at.eye.ng, after, kRefracted, wave.counts.refract);
}

inline void bounceAlone(const Wave& wave, std::size_t k) {
    if (isPlainMirror(*wave.memory.points.material[k]))
        mirror(wave, k);
    else
        bounce(wave, k);
}

} // namespace waves
