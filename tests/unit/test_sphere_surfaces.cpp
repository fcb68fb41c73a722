// Surfaces of many hits on one sphere: every kernel gives the bits of asking hit by hit, whichever
// rays of the batch have met it.
#include "analytic_kit.h"
#include "check.h"

#include <bit>

using kit::Random;

namespace {

bool sameBits(Vec3 a, Vec3 b) {
    using Bits = std::uint32_t;
    return std::bit_cast<Bits>(a.x) == std::bit_cast<Bits>(b.x) &&
           std::bit_cast<Bits>(a.y) == std::bit_cast<Bits>(b.y) &&
           std::bit_cast<Bits>(a.z) == std::bit_cast<Bits>(b.z);
}
bool sameBits(const Surface& a, const Surface& b) {
    return sameBits(a.p, b.p) && sameBits(a.ng, b.ng) && sameBits(a.ns, b.ns) && a.uv == b.uv &&
           a.material == b.material && a.object == b.object && a.error == b.error &&
           a.rayError == b.rayError && a.lift == b.lift;
}

// Some rays of the batch miss, by `missing` of them, so that those that hit have gaps; they start
// in one point or in many, outside of the ball or in it.
void checkSphere(const Sphere& sphere, const Transform& map, Random& random, double missing) {
    std::vector<Vec3> org, dir;
    std::vector<float> tMin, tMax, time;
    std::vector<Hit> hits;
    std::vector<std::uint32_t> which;
    const bool fromOnePoint = random.coin();
    const Vec3d eye = map.point(random.inBox(3));
    for (std::uint32_t i = 0; i < 61; ++i) {
        const Vec3d from = fromOnePoint ? eye : map.point(random.inBox(3));
        const Vec3d to = map.point(random.inBox(1));
        const Ray ray{toFloat(from), toFloat(to - from), 0, kInfinityF, 0};
        org.push_back(ray.org), dir.push_back(ray.dir);
        tMin.push_back(ray.tMin), tMax.push_back(ray.tMax), time.push_back(ray.time);
        hits.emplace_back();
        if (!random.chance(missing) && sphere.intersect(ray, hits.back())) which.push_back(i);
    }
    const RaySpan rays{org, dir, tMin, tMax, time};
    for (const Kernel& kernel : allKernels()) {
        if (!kernel.supported()) continue;
        for (const SurfaceNeeds needs : {SurfaceNeeds{true, true}, {false, true}}) {
            std::vector<std::pair<int, Surface>> out(which.size());
            if (out.empty()) continue;
            sphere.surfaces({rays, hits, which, needs, sphereSurfaces(kernel)},
                            {&out[0].second, sizeof(out[0])});
            for (std::size_t k = 0; k < which.size(); ++k)
                CHECK_INFO(sameBits(out[k].second,
                                    sphere.surfaceFor(rays[which[k]], hits[which[k]], needs)),
                           std::string(kernel.name) + ", hit " + std::to_string(k) + " of " +
                               std::to_string(which.size()) + ", ray " + std::to_string(which[k]));
        }
    }
}

} // namespace

TEST(sphere_surfaces_are_those_of_single_hits) {
    Random random(3301);
    for (int i = 0; i < check::scaled(400); ++i) {
        const Transform map =
            i % 3 == 0 ? Transform::translate(random.inBox(5)) : kit::randomMap(random);
        const double radius = i % 5 == 0 ? random.logUniform(1e-6, 1e3) : 1;
        const Sphere sphere(map, radius, 7, 9);
        checkSphere(sphere, map * Transform::scale(radius), random, i % 2 == 0 ? 0.1 : 0);
    }
}

// What lanes are not for is asked one by one.
TEST(sphere_surfaces_of_moving_and_flat_spheres) {
    Random random(3302);
    for (int i = 0; i < check::scaled(20); ++i) {
        const Transform keys[] = {kit::randomMap(random), kit::randomMap(random)};
        checkSphere(Sphere(MovingTransform{std::span(keys)}, 1, 2, 3), keys[0], random, 0.1);
        const Transform flat = kit::randomMap(random) * Transform::scale({1, 1, 0});
        checkSphere(Sphere(flat, 1, 2, 3), flat, random, 0.1);
    }
}
