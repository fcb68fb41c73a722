#include "analytic_checks.h"

namespace test_disk {

TEST(disk_keeps_the_rules_of_shapes) { kit::checkShape("disk", 501); }

TEST(disk_uv_and_edge_cases) {
    const Disk disk(Transform(), 2, 0, 0);
    const Ray down{{1, -0.5f, 3}, {0, 0, -1}};
    Hit hit;
    CHECK(disk.intersect(down, hit));
    const Surface at = disk.surface(down, hit);
    CHECK_EQUAL(hit.t, 3.0f);
    CHECK(at.p == (Vec3{1, -0.5f, 0}) && at.ng == (Vec3{0, 0, 1}));
    CHECK_NEAR(at.uv.x, 0.75, 1e-7);
    CHECK_NEAR(at.uv.y, 0.375, 1e-7);
    // From below the normal is the same.
    const Ray up{{1, -0.5f, -3}, {0, 0, 1}};
    hit = {};
    CHECK(disk.intersect(up, hit));
    CHECK(disk.surface(up, hit).ng == (Vec3{0, 0, 1}));
    hit = {};
    CHECK(disk.intersect({{2, 0, 1}, {0, 0, -1}}, hit)); // the rim belongs to it
    CHECK(!disk.intersect({{2.0000002f, 0, 1}, {0, 0, -1}}, hit));
    CHECK(!disk.intersect({{-5, 0, 0}, {1, 0, 0}}, hit)); // in its plane
    for (const float angle : {1e-1f, 1e-4f, 1e-7f}) {     // grazing
        hit = {};
        CHECK(disk.intersect({{-1, 0, angle}, {1, 0, -angle}}, hit));
        CHECK_EQUAL(hit.t, 1.0f);
    }
    for (const double radius : {0.0, -1.0, std::nan("")}) {
        hit = {};
        CHECK(!Disk(Transform(), radius, 0, 0).intersect({{0, 0, 1}, {0, 0, -1}}, hit));
    }
}

} // namespace test_disk
