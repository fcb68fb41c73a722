// Stage of the wave: the rays of the next one, in the order of the points that spawn them: straight
// on through what is not opaque, then reflected, then refracted.
#pragma once

#include "render/waves/mirrors.h"
#include "render/waves/steps.h"
#include "render/waves/wave.h"

#include <algorithm>
#include <bit>
#include <cstddef>

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
    explicit BouncesInLanes(const Wave& wave) : wave_(wave) { block_.cutoff = wave.context.cutoff; }

    void add(std::size_t k) {
        const PointBatch& points = wave_.memory.points;
        const ShadedPoint& at = points.at[k];
        const Material& material = *points.material[k];
        const std::size_t i = count_++;
        const auto put = [i](float(*to)[BounceBlock::kPoints], Vec3 v) {
            to[0][i] = v.x, to[1][i] = v.y, to[2][i] = v.z;
        };
        const auto putLight = [&](float(*to)[BounceBlock::kPoints], Rgb c) {
            put(to, {c.r, c.g, c.b});
        };
        put(block_.n, at.eye.n), put(block_.ng, at.eye.ng), put(block_.toEye, at.toEye);
        putLight(block_.mirror, material.mirror);
        putLight(block_.transmission, material.transmission);
        putLight(block_.weight, points.weight[k]);
        points_[i] = k;
        Boundary boundary;
        if (isPlainMirror(material)) {
            boundary.before = boundary.after = wave_.rays.medium[points.ray[k]];
        } else {
            boundary = boundaryAt(wave_, k);
            block_.glass |= 1u << i;
        }
        before_[i] = boundary.before, after_[i] = boundary.after, block_.eta[i] = boundary.eta;
        if (count_ == BounceBlock::kPoints) send();
    }

    // All that wait.
    void send() {
        if (count_ == 0) return;
        block_.used = (1u << count_) - 1;
        wave_.context.bouncesInLanes(block_);
        std::size_t begin = 0;
        for (unsigned rest = block_.bent; rest != 0; rest &= rest - 1) {
            const auto bent = static_cast<std::size_t>(std::countr_zero(rest));
            write(begin, bent);
            bounceAlone(wave_, points_[bent]);
            begin = bent + 1;
        }
        write(begin, count_);
        count_ = 0, block_.glass = 0;
    }

private:
    // What push() does, of the points begin .. end - 1.
    void write(std::size_t begin, std::size_t end) const {
        const unsigned range = (1u << end) - (1u << begin);
        const unsigned reflects = block_.reflects & range, refracts = block_.refracts & range;
        const auto reflected = static_cast<std::size_t>(std::popcount(reflects));
        const auto refracted = static_cast<std::size_t>(std::popcount(refracts));
        wave_.counts.reflect += reflected, wave_.counts.refract += refracted;
        const PointBatch& points = wave_.memory.points;
        const PathBatch& from = wave_.rays;
        PathBatch& next = wave_.memory.next;
        std::size_t to = next.extend(reflected + refracted);
        // Nothing is rough.
        std::fill_n(next.seesLights.begin() + static_cast<std::ptrdiff_t>(to),
                    reflected + refracted, std::uint8_t{true});
        Vec3 *const org = next.org.data(), *const dirs = next.dir.data();
        float *const tMin = next.tMin.data(), *const tMax = next.tMax.data(),
                     *const time = next.time.data();
        std::uint32_t *const sample = next.sample.data(), *const stream = next.stream.data();
        Rgb* const weights = next.weight.data();
        MediumTree::Inside* const inside = next.medium.data();
        using Rows = float[3][BounceBlock::kPoints];
        const auto put = [&](std::size_t i, std::size_t ray, const Rows& dir, const Rows& weight,
                             Vec3 start, MediumTree::Inside medium, std::uint32_t branch) {
            org[to] = start, dirs[to] = {dir[0][i], dir[1][i], dir[2][i]};
            tMin[to] = 0, tMax[to] = kInfinityF, time[to] = from.time[ray];
            weights[to] = {weight[0][i], weight[1][i], weight[2][i]};
            sample[to] = from.sample[ray], inside[to] = medium;
            stream[to] = low32(hash(from.stream[ray], branch));
            ++to;
        };
        for (unsigned rest = reflects | refracts; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t ray = points.ray[points_[i]];
            const ShadedPoint& at = points.at[points_[i]];
            if ((reflects >> i & 1) != 0)
                put(i, ray, block_.reflectedDir, block_.reflected, leave(at.surface, at.eye.ng),
                    before_[i], kReflected);
            if ((refracts >> i & 1) != 0)
                put(i, ray, block_.refractedDir, block_.refracted, leave(at.surface, -at.eye.ng),
                    after_[i], kRefracted);
        }
    }

    const Wave& wave_;
    BounceBlock block_;
    std::size_t count_ = 0, points_[BounceBlock::kPoints];
    MediumTree::Inside before_[BounceBlock::kPoints], after_[BounceBlock::kPoints];
};

} // namespace waves

template <bool kBounces, bool kSeeThrough> void spawnBounces(const Wave& wave) {
    wave.memory.next.clear();
    if (wave.depth >= wave.context.settings.picture.maxDepth) return;
    const PointBatch& points = wave.memory.points;
    const bool hasLanes = wave.context.bouncesInLanes != nullptr;
    waves::BouncesInLanes lanes(wave);
    for (std::size_t k = 0; k < points.count; ++k) {
        if constexpr (kBounces && !kSeeThrough)
            if (const std::size_t b = k / PointColumns::kPoints;
                k % PointColumns::kPoints == 0 && wave.context.shadeLanes.mirror != nullptr)
                if (const auto mirrors = waves::plainMirrors(wave, b)) {
                    lanes.send();
                    waves::mirrorInLanes(wave, b, *mirrors);
                    k += points.sizeOf(b) - 1;
                    continue;
                }
        const Material& material = *points.material[k];
        if (points.at.of(k).isLamp) continue;
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
