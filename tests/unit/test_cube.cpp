#include "analytic_checks.h"

namespace test_cube {

TEST(cube_keeps_the_rules_of_shapes) { kit::checkShape("cube", 201); }

TEST(cube_does_not_leak_at_edges_and_corners) { CHECK_EQUAL(kit::leaks("cube", 202, 1000000), 0); }

TEST(cube_faces) {
    const Cube cube(Transform(), 0, 0);
    struct {
        Vec3 normal, rightOfFace, upOfFace;
    } const faces[] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
        {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
    };
    for (const auto& face : faces) {
        const Vec3 at = face.normal * 3.0f + face.rightOfFace * 0.5f + face.upOfFace * -0.25f;
        const Ray ray{at, -face.normal};
        Hit hit;
        CHECK(cube.intersect(ray, hit));
        CHECK_EQUAL(hit.t, 2.0f);
        const Surface surface = cube.surface(ray, hit);
        CHECK(surface.ng == face.normal);
        CHECK_NEAR(surface.uv.x, 0.75, 1e-7);
        CHECK_NEAR(surface.uv.y, 0.375, 1e-7);
    }
}

TEST(cube_edge_cases) {
    const Cube cube(Transform(), 0, 0);
    std::vector<Hit> hits;
    cube.collect({{-3, 1, 1}, {1, 0, 0}}, hits); // along an edge: the closed box is met
    CHECK_EQUAL(hits.size(), std::size_t(2));
    Hit hit;
    CHECK(!cube.intersect({{-3, 1.0000001f, 0}, {1, 0, 0}}, hit));
    CHECK(!cube.intersect({{1, 0, 0}, {1, 0, 0}}, hit)); // leaves from its face
    CHECK(cube.intersect({{1, 0, 0}, {-1, 0, 0}}, hit));
    CHECK_EQUAL(hit.t, 2.0f);
    // A grazing ray just above a face misses, just below it goes in through the side.
    for (const double angle : {1e-1, 1e-3, 1e-5, 1e-7}) {
        hit = {};
        const float rise = static_cast<float>(angle);
        CHECK(!cube.intersect({{-1, 0, 1.0000001f}, {1, 0, rise}}, hit));
        CHECK(cube.intersect({{-1.5f, 0, 0.99999994f}, {1, 0, -rise}}, hit));
        CHECK_EQUAL(hit.prim, 0u);
    }
}

// Without mapping the corners.
TEST(cube_box_is_that_of_its_corners) {
    kit::Random random(203);
    for (int i = 0; i < check::scaled(20000); ++i) {
        const Transform map = kit::randomMap(random);
        BoundsD box;
        for (int corner = 0; corner < 8; ++corner)
            box.extend(map.point(BoundsD{{-1, -1, -1}, {1, 1, 1}}.corner(corner)));
        const Bounds found = Cube(map, 0, 0).bounds();
        const Bounds wanted = outward(box.padded(0x1p-22 * max(maxAbs(box.lo), maxAbs(box.hi))));
        CHECK_INFO(found.lo == wanted.lo && found.hi == wanted.hi, "map " << i);
    }
}

} // namespace test_cube
