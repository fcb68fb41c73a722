// Planes without end by the register: every kernel finds the hits of asking ray by ray, bit for
// bit.
#include "accel/kernels/planes.h"
#include "analytic_kit.h"
#include "check.h"
#include "render/shape_set.h"
#include "shape/infinite_plane.h"
#include "verify/hostile_rays.h"

#include <limits>

namespace test_planes {

using kit::Random;

namespace {

// Rays towards the plane, along it, away from it, and such as no plane may meet.
Ray someRay(Random& random, const Transform& map) {
    const Vec3d from = map.point(random.inBox(3));
    Vec3d dir = map.point(random.inBox(3)) - from;
    if (random.chance(0.1)) dir = map.vector({random.uniform(-1, 1), random.uniform(-1, 1), 0});
    if (random.chance(0.1)) dir = dir * random.logUniform(1e-36, 1e34);
    Ray ray{toFloat(from), toFloat(dir), 0, kInfinityF, 0};
    if (random.chance(0.5)) ray.tMin = static_cast<float>(random.logUniform(1e-6, 2));
    if (random.chance(0.5)) ray.tMax = static_cast<float>(random.logUniform(1e-3, 4));
    if (random.chance(0.1)) ray.dir[random.below(3)] = 0;
    if (random.chance(0.03)) ray.dir[random.below(3)] = std::numeric_limits<float>::quiet_NaN();
    if (random.chance(0.03)) ray.org[random.below(3)] = kInfinityF;
    if (random.chance(0.03)) ray.dir = {};
    return ray;
}

} // namespace

TEST(planes_in_lanes_have_the_hits_of_single_rays) {
    constexpr std::uint32_t kNumber = 77;
    Random random(3401);
    std::size_t met = 0, asFarAsBest = 0, hid = 0;
    for (int i = 0; i < check::scaled(400); ++i) {
        const Transform map =
            i % 3 == 0 ? Transform::translate(random.inBox(5)) : kit::randomMap(random);
        const InfinitePlane shape(map, 0, 0);
        const StillPlane plane = *shape.solidForm().plane;
        battery::RayList rays;
        std::vector<Hit> best;
        for (std::uint32_t k = 0; k < 1 + random.below(40); ++k) {
            const Ray ray = someRay(random, map);
            rays.push(ray);
            best.push_back({.t = ray.tMax});
            if (random.chance(0.2)) shape.intersect(ray, best.back()); // as near as it is itself
        }
        for (const Isa& kernel : allIsas()) {
            const PlaneKernel* const lanes = kernel.planes;
            if (!kernel.supported() || lanes == nullptr) continue;
            std::vector<Hit> first(best.size() + 1), nearest = best;
            first.back().v = 1; // behind the last ray: stays as it is
            lanes->first(plane, kNumber, rays.span(), first.data());
            CHECK_INFO(first.back() == Hit{.v = 1}, kernel.name);
            std::vector<PlaneHit> asFar(best.size());
            asFar.resize(lanes->closest(plane, kNumber, rays.span(), nearest.data(), asFar.data()));
            std::vector<std::uint8_t> hidden(best.size(), 0);
            lanes->any(plane, rays.span(), hidden.data());
            std::size_t next = 0;
            for (std::uint32_t k = 0; k < best.size(); ++k) {
                const Ray ray = rays.span()[k];
                const std::string where = std::string(kernel.name) + ", plane " +
                                          std::to_string(i) + ", ray " + std::to_string(k);
                const auto asked = [&](Hit hit) {
                    if (canHit(ray) && shape.intersect(ray, hit)) ++met, hit.shape = kNumber;
                    return hit;
                };
                CHECK_INFO(first[k].isHit() ? first[k] == asked({.t = ray.tMax})
                                            : !asked({.t = ray.tMax}).isHit(),
                           where);
                CHECK_INFO(first[k].isHit() || first[k] == Hit{.t = ray.tMax} ||
                               !(ray.tMax == ray.tMax),
                           where);
                const Hit hit = asked(best[k]);
                const bool isAsFar = hit.isHit() && hit.t == best[k].t;
                CHECK_INFO(nearest[k] == (isAsFar ? best[k] : hit), where);
                if (isAsFar) {
                    const bool isNext = next < asFar.size() && asFar[next].ray == k;
                    CHECK_INFO(isNext && asFar[next].t == hit.t && asFar[next].u == hit.u, where);
                    next += isNext, ++asFarAsBest;
                }
                const bool hides = canHit(ray) && shape.occludes(ray);
                hid += hides;
                CHECK_INFO((hidden[k] != 0) == hides, where);
            }
            CHECK_INFO(next == asFar.size(), std::string(kernel.name) + ", hits of no ray");
        }
    }
    CHECK(met > 1000 && asFarAsBest > 300 && hid > 1000);
}

// What maps to numbers whose squares overflow, or vanish, meets nothing in lanes either.
TEST(planes_of_extreme_scales_have_the_hits_of_single_rays) {
    Random random(3403);
    std::size_t met = 0, missed = 0;
    for (const double scale : {0x1p-520, 0x1p-400, 0x1p400, 0x1p520}) {
        const InfinitePlane shape(Transform::scale(scale), 0, 0);
        const std::optional<StillPlane> plane = shape.solidForm().plane;
        if (!plane) continue;
        battery::RayList rays;
        for (int k = 0; k < 64; ++k)
            rays.push({toFloat(random.inBox(3)), toFloat(random.inBox(1)), 0, kInfinityF, 0});
        for (const Isa& kernel : allIsas()) {
            const PlaneKernel* const lanes = kernel.planes;
            if (!kernel.supported() || lanes == nullptr) continue;
            std::vector<Hit> hits(rays.size());
            lanes->first(*plane, 0, rays.span(), hits.data());
            for (std::size_t k = 0; k < hits.size(); ++k) {
                Hit hit;
                const bool meets = shape.intersect(rays.span()[k], hit);
                (meets ? met : missed) += 1;
                CHECK_INFO(hits[k].isHit() == meets && hits[k].t == hit.t,
                           std::string(kernel.name) + ", scale " + std::to_string(scale));
            }
        }
    }
    CHECK(met > 30 && missed > 30);
}

} // namespace test_planes
