#include "analytic_checks.h"

namespace test_plane {

using kit::Random;

TEST(plane_keeps_the_rules_of_shapes) { kit::checkShape("plane", 701); }

namespace {

Surface seenFromAbove(const Plane& plane, double x, double y) {
    const Ray ray{toFloat(Vec3d{x, y, 5}), {0, 0, -1}};
    Hit hit;
    CHECK_INFO(plane.intersect(ray, hit), x << " " << y);
    return plane.surface(ray, hit);
}

} // namespace

TEST(plane_uv_is_the_inverse_of_the_bilinear_map) {
    Random random(702);
    const std::vector<Plane::Corners> quads = {
        {Vec3d{-1, -1, 0}, Vec3d{1, -1, 0}, Vec3d{1, 1, 0}, Vec3d{-1, 1, 0}},
        {Vec3d{0, 0, 0}, Vec3d{3, 0, 0}, Vec3d{2, 1, 0}, Vec3d{1, 1, 0}},       // trapezoid
        {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{3, 3, 0}, Vec3d{0, 1, 0}},       // kite
        {Vec3d{0, 0, 0}, Vec3d{2, 0, 0}, Vec3d{2, 2, 0}, Vec3d{1e-7, 2, 0}},    // nearly a square
        {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{1.5, 0.001, 0}, Vec3d{0, 1, 0}}, // sharp corner
        kit::kQuad,
    };
    for (const Plane::Corners& c : quads) {
        const Plane plane(Transform(), c, 0, 0);
        for (int i = 0; i < 2000; ++i) {
            const double u = random.unit(), v = random.unit();
            const Vec3d p = lerp(lerp(c[0], c[1], u), lerp(c[3], c[2], u), v);
            const Surface at = seenFromAbove(plane, p.x, p.y);
            // Float rounding of the ray moves p by 1e-7, and uv by that over the smallest slope.
            const Vec3d e = lerp(c[1] - c[0], c[2] - c[3], v),
                        f = lerp(c[3] - c[0], c[2] - c[1], u);
            const double slope = length(cross(e, f)) / max(length(e), length(f));
            CHECK_NEAR(at.uv.x, u, 1e-7 + 4e-7 / slope);
            CHECK_NEAR(at.uv.y, v, 1e-7 + 4e-7 / slope);
            CHECK(at.ng == (Vec3{0, 0, 1}));
        }
    }
    // The corners themselves, from a hair inside.
    const Plane plane(Transform(), kit::kQuad, 0, 0);
    const Vec2 expected[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d p = kit::kQuad[i] * 0.99999;
        const Surface at = seenFromAbove(plane, p.x, p.y);
        CHECK_NEAR(at.uv.x, expected[i].x, 1e-4);
        CHECK_NEAR(at.uv.y, expected[i].y, 1e-4);
    }
}

TEST(plane_covers_its_quadrilateral_only) {
    Random random(703);
    const Plane plane(Transform(), kit::kQuad, 0, 0);
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = random.inBox(1.5);
        double inside = 1; // distance to the nearest edge, negative outside
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3d a = kit::kQuad[k], b = kit::kQuad[(k + 1) % 4];
            inside = min(inside,
                         ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length(b - a));
        }
        if (std::fabs(inside) < 1e-6) continue;
        const Ray ray{toFloat(Vec3d{p.x, p.y, 3}), {0, 0, -1}};
        Hit hit;
        CHECK_EQUAL(plane.intersect(ray, hit), inside > 0);
    }
}

TEST(plane_degenerate_corners) {
    Hit hit;
    const Ray down{{0.25f, 0.25f, 5}, {0, 0, -1}};
    // A triangle (one corner twice) is a quadrilateral too.
    const Plane triangle(Transform(),
                         {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 1, 0}}, 0, 0);
    CHECK(triangle.intersect(down, hit));
    const Surface at = triangle.surface(down, hit);
    CHECK(at.uv.x >= 0 && at.uv.x <= 1 && at.uv.y >= 0 && at.uv.y <= 1);
    hit = {};
    CHECK(!triangle.intersect({{0.75f, 0.75f, 5}, {0, 0, -1}}, hit));
    // Clockwise corners: the normal looks the other way.
    const Plane turned(Transform(),
                       {Vec3d{-1, 1, 0}, Vec3d{1, 1, 0}, Vec3d{1, -1, 0}, Vec3d{-1, -1, 0}}, 0, 0);
    CHECK(turned.intersect(down, hit));
    CHECK(turned.surface(down, hit).ng == (Vec3{0, 0, -1}));
    hit = {};
    const Plane line(Transform(), {Vec3d{0, 0, 0}, Vec3d{1, 1, 0}, Vec3d{2, 2, 0}, Vec3d{3, 3, 0}},
                     0, 0);
    CHECK(!line.intersect(down, hit));
    const Plane point(Transform(), {Vec3d{}, Vec3d{}, Vec3d{}, Vec3d{}}, 0, 0);
    CHECK(!point.intersect(down, hit));
    // Standing planes, about each axis.
    const Plane upright(Transform(),
                        {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{1, 0, 1}, Vec3d{0, 0, 1}}, 0, 0);
    const Ray north{{0.25f, -5, 0.75f}, {0, 1, 0}};
    hit = {};
    CHECK(upright.intersect(north, hit));
    const Surface wall = upright.surface(north, hit);
    CHECK(wall.ng == (Vec3{0, -1, 0}));
    CHECK_NEAR(wall.uv.x, 0.25, 1e-7);
    CHECK_NEAR(wall.uv.y, 0.75, 1e-7);
}

} // namespace test_plane
