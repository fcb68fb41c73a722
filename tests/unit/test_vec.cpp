#include "base/vec.h"
#include "check.h"

namespace test_vec {

// Vectors are usable in constant expressions.
static_assert(dot(Vec3{1, 2, 3}, Vec3{4, 5, 6}) == 32);
static_assert(cross(Vec3d{1, 0, 0}, Vec3d{0, 1, 0}) == Vec3d{0, 0, 1});
static_assert(Vec3{7, 8, 9}[0] == 7 && Vec3{7, 8, 9}[1] == 8 && Vec3{7, 8, 9}[2] == 9);
static_assert(lerp(Vec3{0, 0, 0}, Vec3{2, 4, 8}, 0.25f) == Vec3{0.5f, 1, 2});
static_assert(maxAbs(Vec3d{1, -3, 2}) == 3 && maxAbs(Vec3d{-4, -3, 2}) == 4);
static_assert(-Vec3{1, -2, 3} == Vec3{-1, 2, -3});
static_assert(Vec2{1, 2} + Vec2{3, 4} == Vec2{4, 6} && Vec2{1, 2} * 3.0f == Vec2{3, 6});

TEST(vec_arithmetic) {
    const Vec3d a{1, 2, 3}, b{-4, 5, 0.5};
    CHECK(a + b == (Vec3d{-3, 7, 3.5}));
    CHECK(a - b == (Vec3d{5, -3, 2.5}));
    CHECK(a * 2.0 == 2.0 * a);
    CHECK(a / 2.0 == (Vec3d{0.5, 1, 1.5}));
    Vec3d c = a;
    c += b;
    c -= a;
    c *= 2.0;
    CHECK(c == b * 2.0);
    c[1] = 7;
    CHECK_EQUAL(c.y, 7.0);
    CHECK_EQUAL(length(Vec3d{2, 3, 6}), 7.0);
    CHECK_NEAR(length(normalize(Vec3d{1, -7, 4})), 1, 1e-15);
    // Perpendicular to both, right-handed.
    const Vec3d n = cross(a, b);
    CHECK_EQUAL(dot(n, a), 0.0);
    CHECK_EQUAL(dot(n, b), 0.0);
    CHECK(cross(b, a) == -n);
    CHECK(toDouble(toFloat(Vec3d{0.5, -3, 1e10})) == (Vec3d{0.5, -3, 1e10}));
}

TEST(vec_colours) {
    const Rgb a{0.5f, 0.25f, 1}, b{2, 4, 0.5f};
    CHECK(a + b == (Rgb{2.5f, 4.25f, 1.5f}));
    CHECK(b - a == (Rgb{1.5f, 3.75f, -0.5f}));
    CHECK(a * b == (Rgb{1, 1, 0.5f}));
    CHECK(a * 2 == 2 * a);
    CHECK(a / 2 == (Rgb{0.25f, 0.125f, 0.5f}));
    CHECK(lerp(a, b, 0.5f) == (Rgb{1.25f, 2.125f, 0.75f}));
    Rgb c = a;
    c += b;
    c *= a;
    CHECK(c == (Rgb{1.25f, 1.0625f, 1.5f}));
    CHECK(isBlack(Rgb{}));
    CHECK(!isBlack(Rgb{0, 0, 1e-30f}));
    CHECK_EQUAL(maxChannel(a), 1.0f);
    CHECK_EQUAL(maxChannel(b), 4.0f);
    CHECK_NEAR(luminance({1, 1, 1}), 1, 1e-6);
    CHECK(luminance({0, 1, 0}) > luminance({1, 0, 0}));
}

} // namespace test_vec
