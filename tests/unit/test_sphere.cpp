#include "analytic_checks.h"

namespace test_sphere {

using kit::Random;

TEST(sphere_keeps_the_rules_of_shapes) { kit::checkShape("sphere", 101); }

TEST(sphere_tells_two_hits_with_one_t_apart) {
    // Seen from 10^7 radii away entry and exit have the same float t, and yet their own normals.
    const Sphere sphere(Transform::translate({10, 0, 0}), 1e-6, 0, 0);
    const Ray ray{{0, 0, 0}, {1, 0, 0}};
    std::vector<Hit> hits;
    sphere.collect(ray, hits);
    CHECK_EQUAL(hits.size(), std::size_t(2));
    if (hits.size() != 2) return;
    CHECK(std::fabs(hits[1].t - hits[0].t) <= 2e-6f);
    CHECK_NEAR(sphere.surface(ray, hits[0]).ng.x, -1, 1e-6);
    CHECK_NEAR(sphere.surface(ray, hits[1]).ng.x, 1, 1e-6);
}

TEST(sphere_uv) {
    const Sphere sphere(Transform(), 2, 0, 0);
    const auto uvAt = [&](Vec3d target) {
        const Ray ray = kit::rayThrough(target * 3.0, target);
        Hit hit;
        CHECK(sphere.intersect(ray, hit));
        return sphere.surface(ray, hit).uv;
    };
    CHECK_NEAR(uvAt({1, 0, 0}).x, 0.5, 1e-7);
    CHECK_NEAR(uvAt({1, 0, 0}).y, 0.5, 1e-7);
    CHECK_NEAR(uvAt({0, 1, 0}).x, 0.75, 1e-7);
    CHECK_NEAR(uvAt({0, -1, 0}).x, 0.25, 1e-7);
    CHECK_NEAR(uvAt({0, 0, 1}).y, 1, 1e-7);
    CHECK_NEAR(uvAt({0, 0, -1}).y, 0, 1e-7);
    CHECK_NEAR(uvAt({1, 0, 1}).y, 0.75, 1e-7);
    // The derivatives at the pole keep a direction.
    const Ray down{{0, 0, 9}, {0, 0, -1}};
    Hit hit;
    CHECK(sphere.intersect(down, hit));
    const SurfaceDerivatives d = sphere.derivatives(down, hit);
    CHECK(d.dpdu.y > 0 && d.dpdu.y < 1e-4f && d.dpdv.x < 0);
}

TEST(sphere_edge_cases) {
    const Sphere unit(Transform(), 1, 0, 0);
    Hit hit;
    CHECK(!unit.intersect({{2, 0, 0}, {1, 0, 0}}, hit));     // behind
    CHECK(unit.intersect({{0, 0, 0}, {0, 0, 1e-30f}}, hit)); // from the centre, any length
    CHECK_EQUAL(hit.t, 1e30f);
    hit = {};
    CHECK(!unit.intersect({{-2, 1.0000001f, 0}, {1, 0, 0}}, hit)); // an ulp beside
    CHECK(unit.intersect({{-2, 0.99999994f, 0}, {1, 0, 0}}, hit)); // an ulp inside
    hit = {};
    CHECK(unit.intersect({{1, 0, 0}, {-1, 0, 0}}, hit)); // from the surface itself, t = 0 is none
    CHECK_EQUAL(hit.t, 2.0f);
    hit = {};
    CHECK(!unit.intersect({{1, 0, 0}, {1, 0, 0}}, hit));
    for (const double radius : {0.0, -1.0, std::nan("")}) {
        const Sphere none(Transform(), radius, 0, 0);
        CHECK(!none.intersect({{-2, 0, 0}, {1, 0, 0}}, hit));
    }
}

} // namespace test_sphere
