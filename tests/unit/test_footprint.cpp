// Ray cones and footprints: against rays through neighbouring pixels.
#include "base/ray_cone.h"
#include "camera/camera.h"
#include "check.h"
#include "shape/infinite_plane.h"
#include "shape/sphere.h"
#include "texture/footprint.h"
#include "verify/meshes.h"

#include <cmath>
#include <numbers>

namespace test_footprint {

using meshes::Random;

namespace {

struct Axes {
    double longer, shorter;
};
// The axes of the ellipse with two conjugate axes.
Axes axesOf(Vec2d a, Vec2d b) {
    const double xx = a.x * a.x + b.x * b.x, yy = a.y * a.y + b.y * b.y, xy = a.x * a.y + b.x * b.y;
    const double root = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
    return {std::sqrt((xx + yy) / 2 + root), std::sqrt(std::max((xx + yy) / 2 - root, 0.0))};
}
Vec2d wide(Vec2 v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }

} // namespace

// Within half a level for 95 % of the hits on a plane and a sphere, both axes, by all cameras.
TEST(footprints_are_what_neighbouring_rays_see) {
    Random random(81);
    const Sphere sphere{MovingTransform(Transform()), 1, 0, 0};
    const InfinitePlane plane{MovingTransform(Transform()), 0, 0};
    for (const bool isPerspective : {true, false})
        for (const bool isSphere : {true, false}) {
            const Shape& shape =
                isSphere ? static_cast<const Shape&>(sphere) : static_cast<const Shape&>(plane);
            CameraParams params;
            params.kind = isPerspective ? CameraParams::Kind::Perspective
                                        : CameraParams::Kind::Orthographic;
            params.width = 400, params.height = 300, params.orthoScale = 3;
            params.worldFromCamera =
                MovingTransform(Transform::lookAt({0.3, -3, 1.2}, {0, 0, 0.2}, {0, 0, 1}));
            const Camera camera(params);
            int hits = 0, near = 0;
            while (hits < check::scaled(2000)) {
                const Vec2d at{random.uniform(0, 400), random.uniform(0, 300)};
                // Half a pixel to each side.
                Vec2d uv[5];
                const Vec2d steps[5] = {{0, 0}, {0.5, 0}, {-0.5, 0}, {0, 0.5}, {0, -0.5}};
                bool all = true;
                Ray ray;
                Hit hit;
                Surface surface;
                for (int i = 4; i >= 0 && all; --i) {
                    ray = camera.ray(at + steps[i], {}, 0);
                    hit = {};
                    all = shape.intersect(ray, hit);
                    if (!all) break;
                    surface = shape.surface(ray, hit);
                    uv[i] = wide(surface.uv);
                }
                if (!all || std::fabs(uv[1].x - uv[2].x) > 0.5 ||
                    std::fabs(uv[3].x - uv[4].x) > 0.5)
                    continue; // over the seam
                ++hits;
                const Axes seen = axesOf(uv[1] - uv[2], uv[3] - uv[4]);
                const RayCone cone = camera.cone(ray.dir, 0);
                const UvFootprint found = footprintOn(cone.widthAt(hit.t), ray.dir, surface.ng,
                                                      shape.derivatives(ray, hit));
                const Axes ours = axesOf(wide(found.along), wide(found.across));
                near += std::fabs(std::log2(ours.longer / seen.longer)) < 0.5 &&
                        std::fabs(std::log2(ours.shorter / seen.shorter)) < 0.5;
            }
            CHECK_INFO(near >= 0.95 * hits, "perspective " << isPerspective << " sphere "
                                                           << isSphere << ": " << near << " of "
                                                           << hits);
        }
}

// A cone that is refracted by a plane keeps the product of index, width and spread, and widens as
// Snell's law says, in the plane of the ray and across it together.
TEST(cones_are_refracted_by_snells_law) {
    for (const double eta : {1 / 1.5, 1.5})
        for (double sine = 0.05; sine < 0.6; sine += 0.05) {
            const auto cosine = [](double s) { return std::sqrt(1 - s * s); };
            const double before = cosine(sine), behind = cosine(eta * sine);
            const RayCone cone{0.1f, 0.01f};
            const RayCone out = cone.refracted(static_cast<float>(eta), static_cast<float>(before),
                                               static_cast<float>(behind));
            const double step = 1e-5;
            const auto angle = [](double s) { return std::asin(s); };
            const double inPlane = (angle(eta * std::sin(angle(sine) + step)) -
                                    angle(eta * std::sin(angle(sine) - step))) /
                                   (2 * step);
            CHECK_NEAR(double{out.spread}, 0.01 * std::sqrt(inPlane * eta), 1e-5);
            CHECK_NEAR(double{out.width}, 0.1 * std::sqrt(behind / before), 1e-6);
        }
}

// The sphere of directions, cut into as many parts as there are samples.
TEST(cones_widen_by_density) {
    const RayCone cone{0.5f, 0.001f};
    const float even = 1 / (4 * std::numbers::pi_v<float>);
    CHECK_EQUAL(cone.scattered(even, 1).spread, 0.3f);
    const RayCone narrow = cone.scattered(1e4f, 0.25f);
    CHECK_NEAR(double{narrow.spread}, 2 * std::sqrt(0.25 / 1e4 / std::numbers::pi), 1e-6);
    CHECK_EQUAL(narrow.width, 0.5f);
    CHECK_EQUAL(cone.scattered(1e12f, 1).spread, 0.001f); // never less than it was
    CHECK_EQUAL(cone.from(2).width, 0.502f);
}

// Where it can't be told, pictures are looked up at points.
TEST(footprints_without_texture_coordinates_are_points) {
    const Vec3 down{0, 0, -1}, up{0, 0, 1};
    CHECK(footprintOn(1, down, up, {{1, 0, 0}, {1, 0, 0}}).isPoint());
    CHECK(footprintOn(1, down, up, {{}, {}}).isPoint());
    CHECK(footprintOn(kInfinityF, down, up, {{1, 0, 0}, {0, 1, 0}}).isPoint());
    CHECK(!footprintOn(1, down, up, {{1, 0, 0}, {0, 1, 0}}).isPoint());
    const UvFootprint level = footprintOn(1, {1, 0, 0}, up, {{1, 0, 0}, {0, 1, 0}});
    CHECK_NEAR(double{level.along.x}, 1024, 1e-3);
    CHECK_NEAR(double{level.across.y}, 1, 1e-6);
}

} // namespace test_footprint
