#include "analytic_checks.h"

namespace test_cylinder {

using kit::Random;

TEST(cylinder_keeps_the_rules_of_shapes) {
    kit::checkShape("cylinder", 301);
    kit::checkShape("tube", 302);
}

TEST(cylinder_does_not_leak_at_its_rims) { CHECK_EQUAL(kit::leaks("cylinder", 303, 1000000), 0); }

TEST(cylinder_parts_and_uv) {
    const Cylinder cylinder(Transform(), 2, true, 0, 0);
    const auto seen = [&](Vec3 org, Vec3 dir) {
        const Ray ray{org, dir};
        Hit hit;
        CHECK(cylinder.intersect(ray, hit));
        return cylinder.surface(ray, hit);
    };
    const Surface side = seen({0, 5, 0.5f}, {0, -1, 0});
    CHECK(side.ng == (Vec3{0, 1, 0}) && side.p == (Vec3{0, 2, 0.5f}));
    CHECK_NEAR(side.uv.x, 0.75, 1e-7);
    CHECK_NEAR(side.uv.y, 0.75, 1e-7);
    const Surface top = seen({1, -0.5f, 3}, {0, 0, -1});
    CHECK(top.ng == (Vec3{0, 0, 1}) && top.p == (Vec3{1, -0.5f, 1}));
    CHECK_NEAR(top.uv.x, 0.75, 1e-7);
    CHECK_NEAR(top.uv.y, 0.375, 1e-7);
    const Surface bottom = seen({1, -0.5f, -3}, {0, 0, 1});
    CHECK(bottom.ng == (Vec3{0, 0, -1}));
    CHECK_NEAR(bottom.uv.x, 0.25, 1e-7); // unmirrored from below
    CHECK_NEAR(bottom.uv.y, 0.375, 1e-7);
}

TEST(cylinder_without_caps_is_open) {
    const Cylinder tube(Transform(), 1, false, 0, 0);
    std::vector<Hit> hits;
    tube.collect({{0, 0, 5}, {0, 0, -1}}, hits); // through it
    CHECK(hits.empty());
    tube.collect({{0.5f, 0, 5}, {0.1f, 0, -1}}, hits); // in at the top, out through the side
    CHECK_EQUAL(hits.size(), std::size_t(1));
    hits.clear();
    tube.collect({{-5, 0, 0.25f}, {1, 0, 0}}, hits);
    CHECK_EQUAL(hits.size(), std::size_t(2));
    hits.clear();
    tube.collect({{-5, 0, 1.0000001f}, {1, 0, 0}}, hits);
    CHECK(hits.empty());
}

TEST(cylinder_edge_cases) {
    Hit hit;
    for (const double radius : {0.0, -1.0, std::nan("")}) {
        const Cylinder none(Transform(), radius, true, 0, 0);
        CHECK(!none.intersect({{-2, 0, 0}, {1, 0, 0}}, hit));
        CHECK(!none.intersect({{0, 0, 3}, {0, 0, -1}}, hit));
    }
    const Cylinder cylinder(Transform(), 1, true, 0, 0);
    std::vector<Hit> hits;
    cylinder.collect({{1, 0, 3}, {0, 0, -1}}, hits); // down the side: the closed solid is met
    CHECK_EQUAL(hits.size(), std::size_t(2));
    for (const float slope : {1e-1f, 1e-3f, 1e-5f, 1e-7f, 1e-20f}) {
        hit = {};
        CHECK(cylinder.intersect({{0, 0, 0}, {slope, 0, 1}}, hit)); // from inside, nearly axial
        CHECK(hit.prim == 2u);
        CHECK_EQUAL(hit.t, 1.0f);
    }
}

} // namespace test_cylinder
