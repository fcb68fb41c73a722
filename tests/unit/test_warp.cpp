#include "base/math.h"
#include "check.h"
#include "sample/warp.h"
#include "warp_kit.h"

#include <random>
#include <vector>

namespace test_warp {

namespace {

struct Draw {
    std::mt19937_64 engine{31}; // the seed of all tests here
    float unit() { return static_cast<float>(engine() >> 40) * 0x1p-24f; }
    Vec2 square() {
        const float x = unit();
        return {x, unit()};
    }
};

constexpr int kSide = 400; // regular points (i + 1/2) / kSide: means are good to about 1e-4

// Means of up to three functions of the mapped regular points.
template <class Function> Vec3d meanOver(Function function) {
    Vec3d sum;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j)
            sum += function(Vec2{(static_cast<float>(i) + 0.5f) / kSide,
                                 (static_cast<float>(j) + 0.5f) / kSide});
    return sum / static_cast<double>(kSide * kSide);
}

double length2(Vec2 p) { return sqr(static_cast<double>(p.x)) + sqr(static_cast<double>(p.y)); }
double number(float x) { return static_cast<double>(x); }

} // namespace

// Uniform on a disk: share inside radius r is r^2; x^2 and y^2 have mean 1/4, xy none.
TEST(warp_disk) {
    Draw draw;
    CHECK(diskFromSquare({0.5f, 0.5f}) == Vec2{});
    for (int i = 0; i < 10000; ++i) {
        const Vec2 u = draw.square(), p = diskFromSquare(u);
        // Concentric: the radius is the larger distance from the middle.
        const double radius = max(std::fabs(2 * number(u.x) - 1), std::fabs(2 * number(u.y) - 1));
        CHECK_NEAR(std::sqrt(length2(p)), radius, 2e-7);
    }
    const Vec3d moments = meanOver([](Vec2 u) {
        const Vec2 p = diskFromSquare(u);
        return Vec3d{sqr(number(p.x)), sqr(number(p.y)), number(p.x) * number(p.y)};
    });
    CHECK_NEAR(moments.x, 0.25, 2e-5);
    CHECK_NEAR(moments.y, 0.25, 2e-5);
    CHECK_NEAR(moments.z, 0, 1e-6);
    // And in every direction: a sector of angle a has the share a / 2 pi.
    for (const double angle : {0.1, 0.7, 1.5, 3.0}) {
        const Vec3d share = meanOver([&](Vec2 u) {
            const Vec2 p = diskFromSquare(u);
            double at = std::atan2(number(p.y), number(p.x));
            if (at < 0) at += kTwoPi;
            return Vec3d{at < angle ? 1.0 : 0.0, 0, 0};
        });
        CHECK_NEAR(share.x, angle / kTwoPi, 2e-3);
    }
}

// Regular polygon with n corners on the unit circle: mean of r^2 is (2 + cos(2 pi / n)) / 6.
TEST(warp_polygon) {
    Draw draw;
    for (const int blades : {3, 4, 5, 6, 8}) {
        const double rotation = 0.3, step = kTwoPi / blades;
        for (int i = 0; i < 5000; ++i) {
            const Vec2 p = Polygon(blades, rotation).fromSquare(draw.square());
            for (int k = 0; k < blades; ++k) { // inside of each side
                const double side = rotation + (k + 0.5) * step;
                CHECK(number(p.x) * std::cos(side) + number(p.y) * std::sin(side) <=
                      std::cos(step / 2) + 1e-7);
            }
        }
        const Vec3d moments = meanOver([&](Vec2 u) {
            const Vec2 p = Polygon(blades, rotation).fromSquare(u);
            return Vec3d{number(p.x), number(p.y), length2(p)};
        });
        CHECK_NEAR(moments.x, 0, 3e-3);
        CHECK_NEAR(moments.y, 0, 3e-3);
        CHECK_NEAR(moments.z, (2 + std::cos(step)) / 6, 1e-3);
    }
    // The first corner lies at the rotation.
    const Vec2 corner = Polygon(5, 0.3).fromSquare({0, kOneMinusUlp});
    CHECK_NEAR(corner.x, std::cos(0.3), 1e-6);
    CHECK_NEAR(corner.y, std::sin(0.3), 1e-6);
    CHECK(Polygon(0, 1).fromSquare({0.3f, 0.6f}) == diskFromSquare({0.3f, 0.6f}));
}

TEST(warp_directions_are_unit) {
    Draw draw;
    for (int i = 0; i < 20000; ++i) {
        const Vec2 u = draw.square();
        const float exponent = draw.unit() * 1000;
        for (const Vec3 v : {coneFromSquare(u, draw.unit()), sphereFromSquare(u),
                             cosineHemisphereFromSquare(u), cosinePowerFromSquare(u, exponent)}) {
            // Some five roundings to float of each axis.
            CHECK_NEAR(length(toDouble(v)), 1, 3e-7);
        }
        CHECK(cosineHemisphereFromSquare(u).z >= 0);
        CHECK(cosinePowerFromSquare(u, exponent).z >= 0);
    }
}

// Densities, by the mean of z and z^2 (the height decides) and of x^2 (no direction is preferred).
TEST(warp_densities) {
    const auto moments = [](auto warp) {
        return meanOver([&](Vec2 u) {
            const Vec3d v = toDouble(warp(u));
            return Vec3d{v.z, v.z * v.z, v.x * v.x};
        });
    };
    const Vec3d sphere = moments(sphereFromSquare);
    CHECK_NEAR(sphere.x, 0, 1e-6);
    CHECK_NEAR(sphere.y, 1.0 / 3, 1e-5);
    CHECK_NEAR(sphere.z, 1.0 / 3, 1e-5);
    const Vec3d cosine = moments(cosineHemisphereFromSquare); // density cos / pi
    CHECK_NEAR(cosine.x, 2.0 / 3, 1e-4);
    CHECK_NEAR(cosine.y, 0.5, 1e-4);
    CHECK_NEAR(cosine.z, 0.25, 1e-4);
    for (const double h : {0.001, 0.3, 1.0}) { // cone: z uniform in [1-h, 1]
        const Vec3d cone =
            moments([&](Vec2 u) { return coneFromSquare(u, static_cast<float>(h)); });
        CHECK_NEAR(cone.x, 1 - h / 2, 1e-6);
        CHECK_NEAR(cone.y, 1 - h + h * h / 3, 1e-5);
        CHECK_NEAR(cone.z, (1 - cone.y) / 2, 1e-5);
    }
    for (const float n : {0.0f, 1.0f, 50.0f, 1e5f}) { // density ~ cos^n
        const Vec3d lobe = moments([&](Vec2 u) { return cosinePowerFromSquare(u, n); });
        CHECK_NEAR(lobe.x, (number(n) + 1) / (number(n) + 2), 1e-4);
        CHECK_NEAR(lobe.y, (number(n) + 1) / (number(n) + 3), 1e-4);
        CHECK_NEAR(lobe.z, (1 - lobe.y) / 2, 1e-5);
    }
    // A narrow cone keeps its digits: the sun's half angle of 0.00465.
    const double half = 0.00465, h = 2 * sqr(std::sin(half / 2));
    const Vec3d edge = toDouble(coneFromSquare({kOneMinusUlp, 0}, static_cast<float>(h)));
    CHECK_NEAR(std::atan2(edge.x, edge.z), half, 1e-9);
}

// Perpendicular and right-handed for all directions, the poles and z near -1 too.
TEST(warp_frame) {
    Draw draw;
    std::vector<Vec3> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0, 0, -0.0f}};
    directions.back() = {1, 0, -0.0f};
    for (int i = 0; i < 20000; ++i) {
        directions.push_back(sphereFromSquare(draw.square()));
        const Vec3 cap = coneFromSquare(draw.square(), 1e-7f);
        directions.push_back({cap.x, cap.y, -cap.z});
    }
    for (const Vec3 z : directions) {
        const Frame frame = frameAround(z);
        CHECK(frame.z == z);
        const Vec3d x = toDouble(frame.x), y = toDouble(frame.y), zd = toDouble(z);
        // Floats round by 6e-8, and z itself may be off unit length by 1e-7.
        CHECK_NEAR(dot(x, y), 0, 3e-7);
        CHECK_NEAR(dot(x, zd), 0, 3e-7);
        CHECK_NEAR(dot(y, zd), 0, 3e-7);
        CHECK_NEAR(length(x), 1, 3e-7);
        CHECK_NEAR(length(y), 1, 3e-7);
        CHECK(length(cross(x, y) - zd) < 6e-7);
        const Vec3 local = frame.toLocal(frame.toWorld({0.25f, -0.5f, 0.75f}));
        CHECK(maxAbs(local - Vec3{0.25f, -0.5f, 0.75f}) < 1e-6f);
    }
}

} // namespace test_warp
