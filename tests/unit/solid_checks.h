// What the tests of solids in batches share: shapes, rays, and the comparison of a set that answers
// batches with one that asks every shape for every ray.
#pragma once

#include "analytic_kit.h"
#include "check.h"
#include "scene/shape_set.h"
#include "shape/one_sided.h"
#include "verify/hostile_rays.h"

#include <cstdio>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace solid_checks {

// Every so often seen from one side only.
inline std::unique_ptr<const Shape> sided(meshes::Random& random,
                                          std::unique_ptr<const Shape> shape, double often) {
    if (!random.chance(often)) return shape;
    return std::make_unique<OneSided>(std::move(shape), random.chance(0.5) ? OneSided::Side::Front
                                                                           : OneSided::Side::Back);
}

using Rays = battery::RayList;

// From a point to another one. Those that are to end do so there, or a few roundings off it; now
// and then one begins there.
inline Ray rayBetween(meshes::Random& random, Vec3d from, Vec3d to, bool ends) {
    Ray ray = kit::rayFrom(from, to - toDouble(toFloat(from)));
    const auto nearTo = [&] { return static_cast<float>(1 + random.uniform(-2, 2) * 0x1p-20); };
    if (ends || random.chance(0.3)) ray.tMax = nearTo();
    if (random.chance(0.1)) ray.tMin = nearTo(), ray.tMax = kInfinityF;
    return ray;
}

struct Score {
    long long rays = 0, hits = 0, hidden = 0, wrongHits = 0, wrongHidden = 0;
    std::set<std::uint32_t> seen; // shapes
};

inline void compare(const char* kernel, std::uint64_t seed, const ShapeSet& batches,
                    const ShapeSet& single, const Rays& rays, Score& score) {
    std::vector<Hit> hits;
    std::vector<std::uint8_t> hidden;
    batches.closest(rays.span(), hits);
    batches.occluded(rays.span(), hidden);
    for (std::size_t i = 0; i < rays.org.size(); ++i) {
        const Ray ray = rays.span()[i];
        const Hit wanted = single.closest(ray);
        ++score.rays;
        score.hits += wanted.isHit();
        if (wanted.isHit()) score.seen.insert(wanted.shape);
        if (!battery::haveSameBits(hits[i], wanted) && ++score.wrongHits <= 3)
            CHECK_INFO(false, kernel << " seed " << seed << " ray " << i << ": shape "
                                     << hits[i].shape << " at " << hits[i].t << " and "
                                     << wanted.shape << " at " << wanted.t);
        const bool isHidden = single.occluded(ray);
        score.hidden += isHidden;
        if ((hidden[i] != 0) != isHidden && ++score.wrongHidden <= 3)
            CHECK_INFO(false, kernel << " seed " << seed << " ray " << i << ": hidden "
                                     << static_cast<int>(hidden[i]) << " and " << isHidden);
    }
}

inline void checkScore(const char* name, const Isa& kernel, const Score& score) {
    std::printf("%s, %s: %lld rays, %lld hits, %lld hidden, %zu shapes seen\n", name, kernel.name,
                score.rays, score.hits, score.hidden, score.seen.size());
    CHECK_INFO(score.hits > score.rays / 4 && score.hidden > score.rays / 8, kernel.name);
    CHECK_EQUAL(score.wrongHits, 0);
    CHECK_EQUAL(score.wrongHidden, 0);
}

// The sets that fill(seed, kernel, set) makes for `seeds` numbers from `first` on, with the kernels
// that have lanes; what it returns is what makeRays(random, that) aims at.
template <class Fill, class MakeRays>
void compareSets(const char* name, std::uint64_t first, unsigned seeds, const Fill& fill,
                 const MakeRays& makeRays) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported() || kernel.triangles == nullptr) continue;
        Score score;
        for (std::uint64_t seed = first; seed < first + check::scaled(seeds); ++seed) {
            ShapeSet batches, single;
            const auto shapes = fill(seed, kernel, batches);
            const auto same = fill(seed, oneLane(), single);
            batches.finish(true, kernel);
            single.finish(false); // every shape is asked
            meshes::Random random(seed);
            for (int i = 0; i < 8; ++i)
                compare(kernel.name, seed, batches, single, makeRays(random, shapes), score);
        }
        checkScore(name, kernel, score);
    }
}

} // namespace solid_checks
