#include "analytic_checks.h"

namespace test_cone {

using kit::Random;

TEST(cone_keeps_the_rules_of_shapes) {
    kit::checkShape("cone", 401);
    kit::checkShape("inverted cone", 402);
    kit::checkShape("cut cone", 403);
    kit::checkShape("open cone", 404);
}

TEST(cone_does_not_leak_at_rims_and_tip) {
    CHECK_EQUAL(kit::leaks("cone", 405, 1000000), 0);
    CHECK_EQUAL(kit::leaks("cut cone", 406, 300000), 0);
    CHECK_EQUAL(kit::leaks("inverted cone", 407, 300000), 0);
}

TEST(cone_parts_and_uv) {
    const Cone cone(Transform(), 2, 0, true, 0, 0);
    const Ray sideways{{5, 0, 0}, {-1, 0, 0}};
    Hit hit;
    CHECK(cone.intersect(sideways, hit));
    const Surface side = cone.surface(sideways, hit);
    CHECK(side.p == (Vec3{1, 0, 0}));
    const double half = std::sqrt(0.5); // slope 45 degrees
    CHECK_NEAR(side.ng.x, half, 1e-7);
    CHECK_NEAR(side.ng.z, half, 1e-7);
    CHECK_NEAR(side.uv.x, 0.5, 1e-7);
    CHECK_NEAR(side.uv.y, 0.5, 1e-7);

    const Ray upwards{{1, 1, -4}, {0, 0, 1}};
    hit = {};
    CHECK(cone.intersect(upwards, hit));
    const Surface base = cone.surface(upwards, hit);
    CHECK(base.ng == (Vec3{0, 0, -1}) && hit.t == 3);
    CHECK_NEAR(base.uv.x, 0.25, 1e-7);
    CHECK_NEAR(base.uv.y, 0.75, 1e-7);
}

TEST(cone_tip_is_met_and_has_a_normal_of_its_side) {
    for (const bool up : {true, false}) {
        const Cone cone(Transform(), up ? 1 : 0, up ? 0 : 1, true, 0, 0);
        const float side = up ? 1.0f : -1.0f;
        const Ray ray{{0, 0, 4 * side}, {0, 0, -side}};
        Hit hit;
        CHECK(cone.intersect(ray, hit));
        CHECK_EQUAL(hit.t, 3.0f);
        const Surface tip = cone.surface(ray, hit);
        CHECK_NEAR(tip.ng.z, side / std::sqrt(5.0f), 1e-6);
        CHECK_NEAR(length(tip.p - Vec3{0, 0, side}), 0, 40 * tip.error);
        CHECK(tip.uv.x >= 0 && tip.uv.x <= 1 && std::fabs(tip.uv.y - (up ? 1 : 0)) < 1e-4f);
        const SurfaceDerivatives d = cone.derivatives(ray, hit);
        CHECK(length(d.dpdu) > 0 && length(d.dpdv) > 0);
    }
}

TEST(cone_edge_cases) {
    Hit hit;
    const Cone line(Transform(), 0, 0, true, 0, 0);
    CHECK(!line.intersect({{-3, 0.001f, 0}, {1, 0, 0}}, hit));
    // Equal radii: the same hits as a cylinder.
    const Cone straight(Transform(), 0.5, 0.5, true, 0, 0);
    const Cylinder cylinder(Transform(), 0.5, true, 0, 0);
    Random random(409);
    for (int i = 0; i < 20000; ++i) {
        const Vec3d from = random.direction() * 3.0;
        const Ray ray = kit::rayThrough(from, random.inBox(1));
        std::vector<Hit> a, b;
        straight.collect(ray, a);
        cylinder.collect(ray, b);
        CHECK_EQUAL(a.size(), b.size());
        if (a.size() != 2 || b.size() != 2) continue;
        CHECK_NEAR(a[0].t, b[0].t, 1e-6);
        CHECK_NEAR(a[1].t, b[1].t, 1e-6);
        CHECK(a[0].prim == b[0].prim);
    }
    // A ray along the side (the quadratic has no square) and one along the axis.
    const Cone cone(Transform(), 2, 0, true, 0, 0);
    std::vector<Hit> hits;
    cone.collect({{4, 0, -3.5f}, {-1, 0, 1}}, hits); // parallel to the side, below it
    CHECK_EQUAL(hits.size(), std::size_t(2));
    hits.clear();
    cone.collect({{4, 0, -2.5f}, {-1, 0, 1}}, hits); // above it: past the tip
    CHECK(hits.empty());
    cone.collect({{0, 0, -3}, {0, 0, 1}}, hits);
    CHECK_EQUAL(hits.size(), std::size_t(2));
    // The other half of the double cone is not there.
    const Cone open(Transform(), 2, 0, false, 0, 0);
    CHECK(!open.intersect({{-5, 0, 1.5f}, {1, 0, 0}}, hit));
    hits.clear();
    open.collect({{0.25f, 0, 5}, {0, 0, -1}}, hits); // steep, from above the tip: once
    CHECK_EQUAL(hits.size(), std::size_t(1));
}

} // namespace test_cone
