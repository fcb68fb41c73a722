// Rays from where a lamp sits to just in front of a point.
#include "base/ray.h"
#include "check.h"
#include "verify/lamp_ray.h"
#include "verify/meshes.h"

namespace test_lamp_ray {

namespace {

Surface pointAt(Vec3 p, float error, float rayError) {
    Surface s;
    s.p = p, s.error = error, s.rayError = rayError;
    return s;
}

// Where the ray ends, without rounding.
Vec3d endOf(const Ray& ray) {
    return toDouble(ray.org) + toDouble(ray.dir) * static_cast<double>(ray.tMax);
}

} // namespace

// As high as promised, whatever rounding does to the direction, and not much higher.
TEST(lamp_ray_ends_above_its_surface) {
    constexpr int kSeed = 91;
    meshes::Random random(kSeed);
    constexpr double kUnit = 0x1p-24;
    for (int i = 0; i < check::scaled(20000); ++i) {
        const Vec3 n = toFloat(random.direction()),
                   lamp = toFloat(random.direction() * random.logUniform(0.1, 1e4));
        const auto error = static_cast<float>(random.logUniform(1e-9, 1e-5));
        const float rayError = random.chance(0.5) ? 0 : 0x1p-22f;
        const Surface s = pointAt(toFloat(random.inBox(1)), error, rayError);
        const Vec3d way = toDouble(s.p) - toDouble(lamp);
        if (dot(toDouble(n), way) > -1e-3) continue; // the lamp is below
        const Ray ray = rayFromLamp(s, n, lamp, 0.5f);
        CHECK(ray.org == lamp && ray.time == 0.5f && ray.tMin == 0 && ray.tMax < 1);
        const Vec3d off = endOf(ray) - toDouble(s.p);
        const double height = dot(toDouble(n), off), reach = length(way);
        const double kept = static_cast<double>(error) + static_cast<double>(rayError) * reach;
        // tMax is rounded down to 2^-24, and the end rises a little less than the step is long.
        const double most = kept + 6 * kUnit * reach + static_cast<double>(error);
        CHECK_INFO(height >= kept * (1 - 1e-6) && height <= most,
                   "seed " << kSeed << " case " << i << ": " << height << " of " << kept);
        CHECK_INFO(length(off) <= 2 * most, "seed " << kSeed << " case " << i);
    }
}

// From straight above all of the height is a step back: the direction is that to the point itself.
TEST(lamp_ray_moves_no_shadow_where_it_need_not) {
    const Surface s = pointAt({0.25f, 0.5f, 0}, 0x1p-20f, 0);
    const Ray ray = rayFromLamp(s, {0, 0, 1}, {0.25f, 0.5f, 2}, 0);
    CHECK(ray.dir.x == 0 && ray.dir.y == 0);
    CHECK(ray.dir.z >= -2 && ray.dir.z <= -2 + 0x1p-22f); // what rounding may take
    CHECK(ray.tMax <= 1 - 0x1p-21f && ray.tMax >= 1 - 0x1p-21f - 0x1p-23f);
}

// A lamp on the surface has nothing in front of it.
TEST(lamp_ray_to_a_lamp_at_the_surface) {
    const Surface s = pointAt({1, 0, 0}, 0x1p-20f, 0x1p-22f);
    for (const float height : {0.0f, 0x1p-22f, 0x1p-20f}) {
        const Ray ray = rayFromLamp(s, {0, 0, 1}, {1, 0, height}, 0);
        CHECK_INFO(!(ray.tMax > ray.tMin), height);
    }
}

} // namespace test_lamp_ray
