// Planes without end by the register: every kernel finds the hits of asking ray by ray, bit for
// bit.
#include "accel/kernels/planes.h"
#include "analytic_kit.h"
#include "check.h"
#include "render/shape_set.h"
#include "shape/infinite_plane.h"
#include "verify/hostile_rays.h"

#include <limits>

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
    Random random(3401);
    std::size_t met = 0, hid = 0;
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
        for (const Kernel& kernel : allKernels()) {
            const PlaneKernel* const lanes = planeKernel(kernel);
            if (!kernel.supported() || lanes == nullptr) continue;
            std::vector<PlaneHit> found(best.size());
            found.resize(lanes->closest(plane, rays.span(), best, found.data()));
            std::vector<std::uint8_t> hidden(best.size(), 0);
            lanes->any(plane, rays.span(), hidden.data());
            std::size_t next = 0;
            for (std::uint32_t k = 0; k < best.size(); ++k) {
                const Ray ray = rays.span()[k];
                const std::string where = std::string(kernel.name) + ", plane " +
                                          std::to_string(i) + ", ray " + std::to_string(k);
                Hit hit = best[k];
                if (canHit(ray) && shape.intersect(ray, hit)) {
                    ++met;
                    const bool isNext = next < found.size() && found[next].ray == k;
                    CHECK_INFO(isNext && found[next].t == hit.t && found[next].u == hit.u, where);
                    next += isNext;
                }
                const bool hides = canHit(ray) && shape.occludes(ray);
                hid += hides;
                CHECK_INFO((hidden[k] != 0) == hides, where);
            }
            CHECK_INFO(next == found.size(), std::string(kernel.name) + ", hits of no ray");
        }
    }
    CHECK(met > 1000 && hid > 1000);
}

TEST(planes_that_move_or_have_one_side_are_not_for_lanes) {
    Random random(3402);
    const Transform keys[] = {kit::randomMap(random), kit::randomMap(random)};
    CHECK(!InfinitePlane(MovingTransform{std::span(keys)}, 0, 0).solidForm().plane);
    CHECK(InfinitePlane(keys[0], 0, 0).solidForm().plane);
}
