// What the tests of solids in batches share: rays, and the comparison of a set that answers batches
// with one that asks every shape for every ray.
#pragma once

#include "check.h"
#include "render/shape_set.h"

#include <set>

namespace solid_checks {

struct Rays {
    std::vector<Vec3> org, dir;
    std::vector<float> tMin, tMax, time;

    void push(const Ray& ray) {
        org.push_back(ray.org), dir.push_back(ray.dir);
        tMin.push_back(ray.tMin), tMax.push_back(ray.tMax), time.push_back(ray.time);
    }
    RaySpan span() const { return {org, dir, tMin, tMax, time}; }
};

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
        if (!(hits[i] == wanted) && ++score.wrongHits <= 3)
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

} // namespace solid_checks
