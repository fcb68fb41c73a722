// Stage of the wave: the rays of the next one, in the order of the points that spawn them: straight
// on through what is not opaque, then reflected, then refracted.
#pragma once

#include "render/waves/steps.h"
#include "render/waves/wave.h"

#include <cstddef>
#include <tuple>

namespace waves {

// Branches of the tree of rays: numbers for Sampler.
inline constexpr std::uint32_t kReflected = 1, kRefracted = 2;

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
    // A rough surface's highlight has counted the lamps; a sharp mirror shows their bodies.
    const bool seesLights = material.roughness <= 0 || isBlack(material.specular);
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

// What a ray is inside of on both sides of a point, and the ior on the eye's side over that on the
// other side.
struct Boundary {
    MediumTree::Inside before, after;
    float eta;
};
inline Boundary boundaryAt(const Wave& wave, std::size_t k) {
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
        u = wave.context.sampler.get2D(rays.stream[i], wave.chunk.ids[rays.sample[i]].index,
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

// Points that wait for lanes, in their order.
class BouncesInLanes {
public:
    explicit BouncesInLanes(const Wave& wave) : wave_(wave) {}

    void add(std::size_t k) {
        const ShadedPoint& at = wave_.memory.points.at[k];
        const Material& material = *wave_.memory.points.material[k];
        const std::size_t i = count_++;
        const auto put = [i](float(*to)[BounceBlock::kPoints], float x, float y, float z) {
            to[0][i] = x, to[1][i] = y, to[2][i] = z;
        };
        const auto [n, ng, toEye] = std::tuple(at.eye.n, at.eye.ng, at.toEye);
        put(block_.n, n.x, n.y, n.z), put(block_.ng, ng.x, ng.y, ng.z);
        put(block_.toEye, toEye.x, toEye.y, toEye.z);
        const Rgb mirror = material.mirror, transmission = material.transmission;
        put(block_.mirror, mirror.r, mirror.g, mirror.b);
        put(block_.transmission, transmission.r, transmission.g, transmission.b);
        points_[i] = k;
        if (isPlainMirror(material)) {
            const MediumTree::Inside here = wave_.rays.medium[wave_.memory.points.ray[k]];
            boundaries_[i] = {here, here, 1};
        } else {
            boundaries_[i] = boundaryAt(wave_, k);
            block_.glass |= 1u << i;
        }
        block_.eta[i] = boundaries_[i].eta;
        if (count_ == BounceBlock::kPoints) send();
    }

    // All that wait.
    void send() {
        if (count_ == 0) return;
        block_.used = (1u << count_) - 1;
        wave_.context.bouncesInLanes(block_);
        const auto pushFrom = [&](std::size_t i, const auto& dir, const auto& weight, Vec3 side,
                                  MediumTree::Inside medium, std::uint32_t branch,
                                  std::uint64_t& counter) {
            push(wave_, points_[i],
                 {{dir[0][i], dir[1][i], dir[2][i]}, {weight[0][i], weight[1][i], weight[2][i]}},
                 side, medium, branch, counter);
        };
        for (std::size_t i = 0; i < count_; ++i) {
            const Vec3 ng = wave_.memory.points.at[points_[i]].eye.ng;
            if ((block_.bent >> i & 1) != 0) {
                bounceAlone(wave_, points_[i]);
                continue;
            }
            if ((block_.reflects >> i & 1) != 0)
                pushFrom(i, block_.reflectedDir, block_.reflected, ng, boundaries_[i].before,
                         kReflected, wave_.counts.reflect);
            if ((block_.refracts >> i & 1) != 0)
                pushFrom(i, block_.refractedDir, block_.refracted, -ng, boundaries_[i].after,
                         kRefracted, wave_.counts.refract);
        }
        count_ = 0, block_.glass = 0;
    }

private:
    const Wave& wave_;
    BounceBlock block_;
    std::size_t count_ = 0, points_[BounceBlock::kPoints];
    Boundary boundaries_[BounceBlock::kPoints];
};

} // namespace waves

template <bool kBounces, bool kSeeThrough> void spawnBounces(const Wave& wave) {
    wave.memory.next.clear();
    if (wave.depth >= wave.context.settings.picture.maxDepth) return;
    const PointBatch& points = wave.memory.points;
    const bool hasLanes = wave.context.bouncesInLanes != nullptr;
    waves::BouncesInLanes lanes(wave);
    for (std::size_t k = 0; k < points.count; ++k) {
        const Material& material = *points.material[k];
        if (points.at[k].of->isLamp) continue;
        if constexpr (kSeeThrough) {
            if (material.opacity < 1) lanes.send();
            waves::goStraight(wave, k);
            if (isBlack(points.weight[k])) continue;
        }
        if constexpr (kBounces)
            if (!isBlack(material.mirror) || !isBlack(material.transmission)) {
                if (hasLanes && (isPlainMirror(material) || isSharpGlass(material))) {
                    lanes.add(k);
                } else {
                    lanes.send();
                    waves::bounceAlone(wave, k);
                }
            }
    }
    lanes.send();
}
