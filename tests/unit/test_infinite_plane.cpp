#include "analytic_checks.h"

namespace test_infinite_plane {

TEST(infinite_plane_keeps_the_rules_of_shapes) { kit::checkShape("infinite plane", 601); }

TEST(infinite_plane_far_and_grazing) {
    const InfinitePlane plane(Transform(), 0, 0);
    for (const float angle : {1.0f, 1e-3f, 1e-7f, 1e-30f}) {
        const Ray ray{{0, 0, 1}, {1, 0, -angle}};
        Hit hit;
        CHECK(plane.intersect(ray, hit));
        CHECK_NEAR(hit.t * angle, 1, 1e-6);
        const Surface at = plane.surface(ray, hit);
        CHECK_EQUAL(at.p.z, 0.0f);
        CHECK(at.ng == (Vec3{0, 0, 1}));
        CHECK_NEAR(at.uv.x * angle, 1, 1e-6);
    }
    Hit hit;
    CHECK(!plane.intersect({{0, 0, 1}, {1, 0, 0}}, hit));
    CHECK(!plane.intersect({{0, 0, 1}, {1, 0, 1}}, hit));
    CHECK(!plane.intersect({{0, 0, 1}, {1, 0, -1e-45f}}, hit)); // t is beyond all floats
    CHECK(!plane.intersect({{3, 4, 0}, {1, 0, -1}}, hit));      // starts on it
}

} // namespace test_infinite_plane
