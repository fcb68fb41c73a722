#include "base/bounds.h"
#include "base/transform.h"
#include "check.h"

#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <string>

namespace test_transform {

namespace {

struct Draw {
    std::mt19937_64 engine{11}; // the seed of all tests here
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
    Vec3d vector(double size) {
        return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
    }
    // Invertible: rotation, factors of both signs with sizes in 0.1..10, rotation, translation.
    Transform transform() {
        const auto factor = [&] {
            const double f = std::exp2(uniform(-3.3, 3.3));
            return uniform(0, 1) < 0.5 ? f : -f;
        };
        return Transform::translate(vector(100)) * Transform::rotate(vector(1), uniform(-7, 7)) *
               Transform::scale({factor(), factor(), factor()}) *
               Transform::rotate(vector(1), uniform(-7, 7));
    }
};

double distance(Vec3d a, Vec3d b) { return length(a - b); }

} // namespace

TEST(transform_inverse) {
    Draw draw;
    for (int i = 0; i < 20000; ++i) {
        const Transform map = draw.transform();
        const Vec3d p = draw.vector(100);
        // Condition up to 100, coordinates up to 1e3: 1e5 * 16 u.
        CHECK(distance(map.inverse().point(map.point(p)), p) < 2e-10);
        // A map made of rows alone finds the same inverse as one composed of parts.
        const Transform again = Transform::fromRows(map.rows());
        CHECK(!again.isSingular());
        CHECK_EQUAL(again.mirrors(), map.mirrors());
        CHECK(distance(again.inverse().point(map.point(p)), p) < 2e-10);
        CHECK_EQUAL(map.determinant() < 0, map.mirrors());
        CHECK(map.inverse().inverse() == map);
    }
}

TEST(transform_singular) {
    CHECK(Transform::fromRows({1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0}).isSingular());
    CHECK(Transform::fromRows({0.1, 0.2, 0.3, 0, 0.4, 0.5, 0.6, 0, 0.7, 0.8, 0.9, 0}).isSingular());
    CHECK(Transform::fromRows({}).isSingular());
    CHECK(Transform::scale({1, 0, 1}).isSingular());
    CHECK(Transform::scale(std::nan("")).isSingular());
    CHECK(Transform::fromRows({1, 0, 0, kInfinity, 0, 1, 0, 0, 0, 0, 1, 0}).isSingular());
    CHECK(Transform::translate({kInfinity, 0, 0}).isSingular());
    CHECK((Transform::scale({1, 0, 1}) * Transform()).isSingular());
    CHECK(Transform::scale({1, 0, 1}).inverse().isSingular());
    // Flat but well defined, tiny and huge maps are not singular.
    CHECK(!Transform::scale({1, 1, 1e-20}).isSingular());
    CHECK(!Transform::fromRows({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1e-20, 0}).isSingular());
    const Transform tiny = Transform::fromRows({0, 1e-150, 0, 1, 1e-150, 0, 0, 2, 0, 0, 1e-150, 3});
    CHECK(!tiny.isSingular());
    CHECK(tiny.mirrors());
    CHECK_NEAR(tiny.inverse().vector({1, 2, 3}).x, 2e150, 1e136);
    CHECK(!Transform::fromRows({1e150, 0, 0, 0, 0, 1e150, 0, 0, 0, 0, 1e150, 0}).isSingular());
}

// The closed form: turns about one axis add up, about two axes they are the quaternion product.
// From the determinant alone, or where that is not certain from the inverse: rows of all sizes, of
// which many are nearly or wholly flat.
TEST(transform_orientation_is_that_of_the_map) {
    Draw draw;
    std::array<int, 3> counts{};
    for (int i = 0; i < check::scaled(20000); ++i) {
        const double size = std::exp2(draw.uniform(-1070, 1000));
        Transform::Rows rows;
        for (double& x : rows) x = draw.uniform(-1, 1) * size;
        const std::size_t row = draw.engine() % 3, other = draw.engine() % 3;
        const int kind = static_cast<int>(draw.engine() % 5);
        for (std::size_t k = 0; k < 3; ++k) {
            double& x = rows[4 * row + k];
            if (kind == 1) x = rows[4 * other + k] * 3;
            if (kind == 2) x = rows[4 * other + k] * (1 + 0x1p-50 * static_cast<double>(k));
            if (kind == 3) x *= std::exp2(draw.uniform(-700, 0));
        }
        if (kind == 4) rows[draw.engine() % 12] = i % 2 == 0 ? kInfinity : std::nan("");
        const Transform map = Transform::fromRows(rows);
        const auto expected = map.isSingular() ? Transform::Orientation::Lost
                              : map.mirrors()  ? Transform::Orientation::Mirrored
                                               : Transform::Orientation::Kept;
        CHECK_INFO(Transform::orientationOf(rows) == expected,
                   "map " + std::to_string(i) + " of kind " + std::to_string(kind));
        ++counts[static_cast<std::size_t>(expected)];
    }
    for (const int count : counts) CHECK(count > check::scaled(20000) / 20);
}

// Maps that only move and scale along the axes are computed by themselves. A zero with a sign makes
// one a map like others, of the same numbers.
TEST(transform_scalings_have_the_bits_of_other_maps) {
    Draw draw;
    const auto bitsOf = [](const Transform& map) {
        std::array<std::uint64_t, 12> bits;
        // Zeros lose their signs, which differ where those of the rows do.
        for (std::size_t i = 0; i < bits.size(); ++i)
            bits[i] = std::bit_cast<std::uint64_t>(map.inverseRows()[i] + 0.0);
        return bits;
    };
    std::array<int, 2> counts{};
    for (int i = 0; i < check::scaled(20000); ++i) {
        Transform::Rows rows{};
        const double size = std::exp2(draw.uniform(-1070, 1000));
        const double spread = i % 2 == 0 ? 3 : i % 4 == 1 ? 120 : 700;
        for (const std::size_t k : {0u, 5u, 10u})
            rows[k] = size * std::exp2(draw.uniform(-spread, 0));
        for (const std::size_t k : {3u, 7u, 11u}) rows[k] = draw.uniform(-1, 1) * size;
        if (draw.engine() % 8 == 0) rows[3] = 0;
        Transform::Rows other = rows;
        other[8] = -0.0;
        const Transform map = Transform::fromRows(rows), like = Transform::fromRows(other);
        const std::string which = "map " + std::to_string(i);
        CHECK_INFO(map.isSingular() == like.isSingular() && !map.mirrors(), which);
        CHECK_INFO(bitsOf(map) == bitsOf(like), which);
        CHECK_INFO(Transform::orientationOf(rows) == Transform::orientationOf(other), which);
        ++counts[map.isSingular() ? 1 : 0];
    }
    for (const int count : counts) CHECK(count > check::scaled(20000) / 20);
}

TEST(transform_rotations) {
    Draw draw;
    for (int i = 0; i < 10000; ++i) {
        const Vec3d axis = draw.vector(3), p = draw.vector(1);
        const double a = draw.uniform(-10, 10), b = draw.uniform(-10, 10);
        const Transform both = Transform::rotate(axis, a) * Transform::rotate(axis, b);
        CHECK(distance(both.point(p), Transform::rotate(axis, a + b).point(p)) < 1e-14);

        const Vec3d other = draw.vector(3);
        const Vec3d u = normalize(axis), v = normalize(other);
        const double ca = std::cos(a / 2), sa = std::sin(a / 2), cb = std::cos(b / 2),
                     sb = std::sin(b / 2);
        const double w = ca * cb - sa * sb * dot(u, v);
        const Vec3d xyz = u * (sa * cb) + v * (ca * sb) + cross(u, v) * (sa * sb);
        const Vec3d turned = p + 2.0 * cross(xyz, cross(xyz, p) + p * w);
        const Transform two = Transform::rotate(axis, a) * Transform::rotate(other, b);
        CHECK(distance(two.point(p), turned) < 1e-14);
        CHECK_NEAR(two.determinant(), 1, 1e-14);
        CHECK_NEAR(length(two.vector(p)), length(p), 1e-14);
    }
    // Right-handed: +x goes to +y about +z.
    CHECK(distance(Transform::rotate({0, 0, 5}, kHalfPi).point({1, 0, 0}), {0, 1, 0}) < 1e-15);
    CHECK(distance(Transform::rotate({1e-200, 0, 0}, kHalfPi).point({0, 1, 0}), {0, 0, 1}) < 1e-15);
}

// A normal of the ellipsoid that a map makes of the unit sphere: the gradient of
// |inverse(x)|^2 = 1, which points outward, mirrored or not.
TEST(transform_normals) {
    Draw draw;
    int mirrored = 0;
    for (int i = 0; i < 20000; ++i) {
        const Transform map = draw.transform();
        mirrored += map.mirrors();
        const Vec3d n = normalize(draw.vector(1)); // a point and the outward normal there
        const Vec3d mapped = normalize(map.normal(n));
        // Outward: a small step along it leaves the ellipsoid.
        CHECK(length(map.inverse().point(map.point(n) + mapped * 1e-4)) > 1);
        // Perpendicular to the mapped tangents.
        const Vec3d tangent = cross(n, draw.vector(1)), other = cross(n, tangent);
        CHECK(std::fabs(dot(mapped, normalize(map.vector(tangent)))) < 1e-12);
        // The cross product of the tangents flips with mirrors(), as documented.
        const Vec3d across = cross(map.vector(tangent), map.vector(other));
        CHECK_EQUAL(dot(across, mapped) * dot(cross(tangent, other), n) < 0, map.mirrors());
    }
    CHECK(mirrored > 5000);
    // A map that flattens to the plane z = 0 still knows the plane's normal.
    const Vec3d flat = Transform::scale({2, 3, 0}).normal({0, 0, 1});
    CHECK(flat.x == 0 && flat.y == 0 && flat.z > 0);
}

TEST(transform_look_at) {
    const Transform camera = Transform::lookAt({1, -5, 2}, {1, 3, 2}, {0, 0, 1}); // along +y
    CHECK(distance(camera.point({0, 0, 0}), {1, -5, 2}) < 1e-15);
    CHECK(distance(camera.vector({0, 0, -1}), {0, 1, 0}) < 1e-15);
    CHECK(distance(camera.vector({0, 1, 0}), {0, 0, 1}) < 1e-15);
    CHECK(distance(camera.vector({1, 0, 0}), {1, 0, 0}) < 1e-15);
    Draw draw;
    for (int i = 0; i < 1000; ++i) {
        const Vec3d eye = draw.vector(10), target = draw.vector(10);
        // Every fifth `up` lies along the view: still a rotation.
        const Vec3d up = i % 5 ? draw.vector(1) : (target - eye) * 3.0;
        const Transform map = Transform::lookAt(eye, target, up);
        CHECK_NEAR(map.determinant(), 1, 1e-13);
        CHECK(distance(map.vector({0, 0, -1}), normalize(target - eye)) < 1e-13);
        if (i % 5) CHECK(dot(map.vector({0, 1, 0}), up) > 0);
        CHECK(std::fabs(dot(map.column(0), map.column(1))) < 1e-13);
    }
    CHECK(!Transform::lookAt({1, 2, 3}, {1, 2, 3}, {0, 0, 0}).isSingular());
}

TEST(transform_rays) {
    Draw draw;
    for (int i = 0; i < 1000; ++i) {
        const Transform map = draw.transform();
        const RayD ray{draw.vector(10), draw.vector(1)};
        const double t = draw.uniform(0, 10);
        CHECK(distance(map.ray(ray).at(t), map.point(ray.at(t))) < 1e-11); // t stays the same
        const Ray single{toFloat(ray.org), toFloat(ray.dir), 0.5f, 7.0f, 0.25f};
        const Ray mapped = map.ray(single);
        CHECK(mapped.tMin == 0.5f && mapped.tMax == 7.0f && mapped.time == 0.25f);
        CHECK(mapped.dir == toFloat(map.vector(toDouble(single.dir))));
    }
}

TEST(transform_bounds) {
    Draw draw;
    for (int i = 0; i < 2000; ++i) {
        const Transform map = draw.transform();
        BoundsD box;
        box.extend(draw.vector(10));
        box.extend(draw.vector(10));
        const BoundsD mapped = map.bounds(box);
        BoundsD corners; // the box of the corners is the tightest
        for (int c = 0; c < 8; ++c) corners.extend(map.point(box.corner(c)));
        CHECK(mapped.contains(corners));
        CHECK(corners.padded(1e-11).contains(mapped));
        for (int k = 0; k < 20; ++k) {
            const Vec3d s{draw.uniform(0, 1), draw.uniform(0, 1), draw.uniform(0, 1)};
            const Vec3d d = box.size();
            CHECK(mapped.contains(map.point(box.lo + Vec3d{s.x * d.x, s.y * d.y, s.z * d.z})));
        }
    }
    CHECK(Transform::scale(2).bounds(BoundsD{}).isEmpty());
    // An infinite plane stays an infinite plane, without NaN.
    const BoundsD plane{{-kInfinity, -kInfinity, 0}, {kInfinity, kInfinity, 0}};
    const BoundsD moved = Transform::translate({1, 2, 3}).bounds(plane);
    CHECK(moved.lo.x == -kInfinity && moved.hi.y == kInfinity);
    CHECK_NEAR(moved.lo.z, 3, 1e-14);
    CHECK_NEAR(moved.hi.z, 3, 1e-14);
}

TEST(bounds_basics) {
    Bounds box;
    CHECK(box.isEmpty());
    CHECK_EQUAL(box.halfArea(), 0.0f);
    CHECK(!box.isFinite());
    box.extend(Vec3{1, 2, 3});
    CHECK(!box.isEmpty());
    CHECK(box.contains(Vec3{1, 2, 3}));
    box.extend(Vec3{3, 5, 4});
    CHECK_EQUAL(box.halfArea(), 2.0f * 3 + 3.0f * 1 + 1.0f * 2);
    CHECK_EQUAL(box.longestAxis(), 1);
    CHECK(box.centre() == (Vec3{2, 3.5f, 3.5f}));
    CHECK(box.corner(5) == (Vec3{3, 2, 4}));
    const Bounds before = box;
    box.extend(Vec3{std::nanf(""), std::nanf(""), std::nanf("")}); // ignored
    CHECK(box == before);
    box.extend(Bounds{}); // neutral
    CHECK(box == before);
    CHECK(merge(box, Bounds{{0, 0, 0}, {1, 1, 1}}) == (Bounds{{0, 0, 0}, {3, 5, 4}}));
    CHECK(intersection(box, Bounds{{0, 0, 0}, {1, 1, 1}}).isEmpty());
    CHECK(!box.overlaps(Bounds{{0, 0, 0}, {1, 1, 1}}));
    CHECK(box.overlaps(Bounds{{0, 0, 0}, {1, 2, 3}})); // touching counts
    CHECK(box.contains(Bounds{}));
    CHECK(!box.contains(Vec3{1, 2, std::nanf("")}));
    CHECK(box.padded(1) == (Bounds{{0, 1, 2}, {4, 6, 5}}));
    CHECK(Bounds{}.padded(1).isEmpty());

    Draw draw;
    for (int i = 0; i < 1000; ++i) {
        BoundsD exactBox;
        exactBox.extend(draw.vector(1000));
        exactBox.extend(draw.vector(1000));
        const Bounds rounded = outward(exactBox);
        CHECK(toDouble(rounded).contains(exactBox));
        CHECK(!toDouble(Bounds{{nextUp(rounded.lo.x), rounded.lo.y, rounded.lo.z}, rounded.hi})
                   .contains(exactBox)); // and no larger than need be
    }
    CHECK(outward(BoundsD{}).isEmpty());
}

} // namespace test_transform
