#include "analytic_kit.h"
#include "check.h"
#include "texture/environment.h"
#include "unit/stored_floats.h"

namespace test_environment {

using kit::Random;

namespace {

// 8 x 4, the texel's number from the top left: 0..31.
StoredImage numbered() {
    std::vector<float> values;
    for (int i = 0; i < 32; ++i) values.push_back(static_cast<float>(i));
    return floats(8, 4, values);
}

Vec3 towards(double longitude, double latitude) {
    return toFloat(Vec3d{std::cos(longitude) * std::cos(latitude),
                         std::sin(longitude) * std::cos(latitude), std::sin(latitude)});
}

} // namespace

TEST(environment_directions) {
    const Environment e(numbered(), ColorSpace::Linear, Interpolation::Nearest, Environment::Up::Z,
                        0);
    const double up = kPi / 8; // row 1, just above the horizon
    // u = 1/2 - longitude / 2 pi: the picture's middle is +x, left of it is +y.
    CHECK_EQUAL(e.radiance(towards(-0.1, up)).r, 8 + 4.0f);
    CHECK_EQUAL(e.radiance(towards(0.1, up)).r, 8 + 3.0f);
    CHECK_EQUAL(e.radiance(towards(kPi / 2 - 0.1, up)).r, 8 + 2.0f);
    CHECK_EQUAL(e.radiance(towards(kPi / 2 + 0.1, up)).r, 8 + 1.0f);
    CHECK_EQUAL(e.radiance(towards(kPi - 0.1, up)).r, 8 + 0.0f);
    CHECK_EQUAL(e.radiance(towards(-kPi + 0.1, up)).r, 8 + 7.0f);
    CHECK_EQUAL(e.radiance(towards(0.1, 1.2)).r, 0 + 3.0f); // the top row is up
    CHECK_EQUAL(e.radiance(towards(0.1, -0.1)).r, 16 + 3.0f);
    CHECK_EQUAL(e.radiance(towards(0.1, -1.2)).r, 24 + 3.0f);
    // Any length.
    CHECK_EQUAL(e.radiance(towards(0.1, -1.2) * 1e-20f).r, 24 + 3.0f);
}

TEST(environment_wraps_round_and_holds_at_the_poles) {
    const Environment e(numbered(), ColorSpace::Linear, Interpolation::Bilinear, Environment::Up::Z,
                        0);
    const double up = kPi / 8;
    // Towards -x: half-way between the last texel and the first.
    CHECK_NEAR(e.radiance(towards(kPi, up)).r, 8 + 3.5, 1e-5);
    CHECK_NEAR(e.radiance(towards(-kPi, up)).r, 8 + 3.5, 1e-5);
    // Above the centres of the top row the picture stays, no bleeding from the bottom.
    const double middle = -kPi / 8; // centre of column 4
    CHECK_NEAR(e.radiance(towards(middle, 1.5)).r, 4, 1e-5);
    CHECK_NEAR(e.radiance(towards(middle, -1.5)).r, 28, 1e-5);
    CHECK(e.radiance({0, 0, 1}).r <= 7 && e.radiance({0, 0, -1}).r >= 24);
}

TEST(environment_turns_with_its_rotation) {
    Random random(1001);
    const double angle = 0.7;
    const Environment plain(numbered(), ColorSpace::Linear, Interpolation::Bilinear,
                            Environment::Up::Z, 0);
    const Environment turned(numbered(), ColorSpace::Linear, Interpolation::Bilinear,
                             Environment::Up::Z, angle);
    for (int i = 0; i < 1000; ++i) {
        const double longitude = random.uniform(-2.3, 2.3), latitude = random.uniform(-1.5, 1.5);
        CHECK_NEAR(turned.radiance(towards(longitude + angle, latitude)).r,
                   plain.radiance(towards(longitude, latitude)).r, 1e-4);
    }
}

TEST(environment_against_the_formula) {
    // A picture whose value is the longitude's u and one with v: bilinear filtering keeps both.
    std::vector<float> us, vs;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x) {
            us.push_back((static_cast<float>(x) + 0.5f) / 128);
            vs.push_back((static_cast<float>(63 - y) + 0.5f) / 64);
        }
    const Environment u(floats(128, 64, us), ColorSpace::Linear, Interpolation::Bilinear,
                        Environment::Up::Z, 0);
    const Environment v(floats(128, 64, vs), ColorSpace::Linear, Interpolation::Bilinear,
                        Environment::Up::Z, 0);
    Random random(1002);
    for (int i = 0; i < 5000; ++i) {
        const Vec3d d = random.direction();
        if (std::fabs(std::atan2(d.y, d.x)) > 3.1 || std::fabs(d.z) > 0.999) continue;
        CHECK_NEAR(u.radiance(toFloat(d)).r, 0.5 - std::atan2(d.y, d.x) / (2 * kPi), 1e-6);
        CHECK_NEAR(v.radiance(toFloat(d)).r, std::asin(d.z) / kPi + 0.5, 2e-6);
    }
}

TEST(environment_any_direction_is_safe) {
    const Environment e(floats(2, 2, {3, 3, 3, 3}), ColorSpace::Linear, Interpolation::Bilinear,
                        Environment::Up::Z, 0);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Vec3 d : {Vec3{0, 0, 0}, Vec3{nan, 0, 0}, Vec3{0, kInfinityF, 0},
                         Vec3{kInfinityF, -kInfinityF, kInfinityF}, Vec3{0, 0, -1e-45f}})
        CHECK_NEAR(e.radiance(d).r, 3, 1e-5);
}

// Up::Y is Up::Z after a quarter turn about x, which takes z to y and y to -z.
TEST(environment_upright_along_y) {
    const Environment z(numbered(), ColorSpace::Linear, Interpolation::Nearest, Environment::Up::Z,
                        0.3);
    const Environment y(numbered(), ColorSpace::Linear, Interpolation::Nearest, Environment::Up::Y,
                        0.3);
    Random random(78);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = toFloat(random.direction());
        CHECK(z.radiance(d) == y.radiance({d.x, d.z, -d.y}));
    }
}

} // namespace test_environment
