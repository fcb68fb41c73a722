// Lamps against closed forms: what arrives, from where, and in which pattern.
#include "base/math.h"
#include "check.h"
#include "light/area_light.h"
#include "light/point_light.h"
#include "light/sun_light.h"
#include "verify/meshes.h"

#include <memory>

namespace test_light {

using meshes::Random;

namespace {

constexpr Rgb kWhite{1, 1, 1};

// Irradiance on a surface at `point` with normal n: the mean over n x n strata with random places.
double irradiance(const Light& light, Vec3 point, Vec3 n, int side, std::uint64_t seed) {
    Random random(seed);
    double sum = 0;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const Vec2 place = random.square();
            const Vec2 u{static_cast<float>((i + static_cast<double>(place.x)) / side),
                         static_cast<float>((j + static_cast<double>(place.y)) / side)};
            const LightSample s =
                light.sample(point, {min(u.x, kOneMinusUlp), min(u.y, kOneMinusUlp)});
            sum += max(static_cast<double>(dot(s.toLight, n)), 0.0) *
                   static_cast<double>(s.irradiance.g);
        }
    }
    return sum / (static_cast<double>(side) * side);
}

FlatLight flat(FlatLight::Outline outline, Vec3 centre, double spreadHalfRad = kHalfPi) {
    return {outline, centre, {0.5f, 0, 0}, {0, 0.25f, 0}, {0, 0, -1}, kWhite, spreadHalfRad, true};
}

} // namespace

TEST(light_point_inverse_square) {
    const PointLight light({1, 2, 3}, {2, 4, 8}, {}, 0, {}, true);
    CHECK(!light.isSoft() && light.castsShadows() && light.origin() == (Vec3{1, 2, 3}));
    Random random(71);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = toFloat(random.inBox(5));
        const Vec3d d = Vec3d{1, 2, 3} - toDouble(p);
        const double r2 = dot(d, d);
        for (const LightSample& s : {light.centre(p), light.sample(p, random.square())}) {
            CHECK_NEAR(s.irradiance.r * r2, 2, 2e-6);
            CHECK_NEAR(s.irradiance.b * r2, 8, 8e-6);
            CHECK_NEAR(s.distance, std::sqrt(r2), 2e-6);
            CHECK(length(toDouble(s.toLight) - normalize(d)) < 1e-6);
        }
    }
    CHECK(isBlack(light.centre({1, 2, 3}).irradiance)); // in the lamp: nothing, and no NaN
}

// I / (a d^2 + b d + c), also with the disk of a soft light seen from afar.
TEST(light_point_attenuation) {
    Random random(77);
    for (int i = 0; i < 300; ++i) {
        const Attenuation fade{static_cast<float>(random.unit()), static_cast<float>(random.unit()),
                               static_cast<float>(random.unit())};
        const Vec3 p = toFloat(random.inBox(20) + Vec3d{25, 0, 0});
        const double d = length(toDouble(p));
        const double expected =
            3 / (static_cast<double>(fade.quadratic) * d * d +
                 static_cast<double>(fade.linear) * d + static_cast<double>(fade.constant));
        const PointLight hard({}, kWhite * 3.0f, fade, 0, {}, true);
        CHECK_NEAR(hard.centre(p).irradiance.g, expected, 1e-6 * expected);
        const PointLight soft({}, kWhite * 3.0f, fade, 1e-3f, {}, true);
        const float soft1 = soft.sample(p, random.square()).irradiance.g;
        CHECK_NEAR(soft1, expected, 1e-5 * expected); // (radius / d)^2 = 4e-6 at most
    }
}

// The soft point light is a disk that faces the receiver: E = I / (r^2 + h^2), the disk's formula
// pi L r^2 / (r^2 + h^2) with L = I / (pi r^2).
TEST(light_soft_point_on_axis) {
    const PointLight light({0, 0, 2}, kWhite, {}, 0.5f, {}, true);
    CHECK(light.isSoft());
    const double e = irradiance(light, {0, 0, 0}, {0, 0, 1}, 64, 72);
    CHECK_NEAR(e, 1 / (0.25 + 4), 1e-4);
    CHECK_NEAR(light.centre({0, 0, 0}).irradiance.g, 0.25, 1e-7);
}

// Form factors of lamps near the receiver: T21 of the battery (Code/verify/lights.cpp).
TEST(light_flat) {
    for (const double h : {0.1, 0.5, 1.0, 4.0}) {
        const FlatLight light(FlatLight::Outline::Ellipse, {0, 0, static_cast<float>(h)},
                              {0.5f, 0, 0}, {0, 0.5f, 0}, {0, 0, -1}, kWhite, kHalfPi, true);
        const double exact = kPi * 0.25 / (0.25 + h * h);
        CHECK_NEAR(irradiance(light, {}, {0, 0, 1}, 200, 74), exact, 1e-3 * exact);
        CHECK(isBlack(
            light.sample({0, 0, static_cast<float>(h) * 2}, {0.3f, 0.3f}).irradiance)); // behind
    }
    // An ellipse has the area pi a b, from afar: E = L A / h^2.
    const FlatLight ellipse = flat(FlatLight::Outline::Ellipse, {0, 0, 100});
    const double far = kPi * 0.125 / 1e4;
    CHECK_NEAR(irradiance(ellipse, {}, {0, 0, 1}, 50, 75), far, 1e-4 * far);
    CHECK_NEAR(ellipse.centre({}).irradiance.g, far, 1e-6 * far);
}

// E = pi L (r/d)^2 for a sphere seen straight on, however near.
TEST(light_sphere) {
    for (const double d : {1.01, 1.5, 3.0, 100.0}) {
        const SphereLight light({0, 0, static_cast<float>(d)}, 1, kWhite, true);
        CHECK(light.isSoft());
        const double exact = kPi / sqr(static_cast<double>(static_cast<float>(d)));
        CHECK_NEAR(irradiance(light, {}, {0, 0, 1}, 100, 77) / exact, 1, 1e-3);
        CHECK_NEAR(light.centre({}).irradiance.g / exact, 1, 1e-5);
    }
    // Samples are on the sphere's near side.
    const SphereLight light({1, 2, 3}, 0.5f, kWhite, true);
    Random random(79);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = toFloat(random.inBox(5));
        const LightSample s = light.sample(p, random.square());
        const Vec3d end = toDouble(p) + toDouble(s.toLight) * static_cast<double>(s.distance);
        const double off = length(end - Vec3d{1, 2, 3}) - 0.5;
        const bool isInside = length(toDouble(p) - Vec3d{1, 2, 3}) < 0.5;
        // Where a direction grazes the sphere, its rounding counts by its square root.
        CHECK_INFO(std::fabs(off) < 1e-4, "off " << off);
        if (!isInside) CHECK(s.distance <= length(Vec3{1, 2, 3} - p));
    }
    // Inside light comes from everywhere: E = pi L.
    CHECK_NEAR(irradiance(light, {1.1f, 2.2f, 2.9f}, {0, 0, 1}, 100, 80), kPi, 5e-3);
}

// The sun's irradiance does not depend on the size of its disk.
TEST(light_sun) {
    const Vec3 down{0, 0, -1};
    for (const double half : {0.0, 0.001, 0.0046, 0.1, 0.5, 1.5}) {
        const SunLight sun(down, {1, 2, 3}, half, true);
        CHECK_EQUAL(sun.isSoft(), half > 0);
        CHECK_NEAR(irradiance(sun, {5, 6, 7}, {0, 0, 1}, 60, 81), 2, 2e-4);
        CHECK_EQUAL(sun.centre({}).irradiance.g, 2.0f);
        CHECK(sun.sample({}, {0.5f, 0.5f}).distance == kInfinityF && !sun.origin());
        Random random(82);
        double widest = 1;
        for (int i = 0; i < 1000; ++i) {
            const LightSample s = sun.sample({}, random.square());
            widest = min(widest, static_cast<double>(s.toLight.z));
            CHECK_NEAR(length(s.toLight), 1, 3e-7);
        }
        CHECK(widest >= std::cos(half) - 1e-6 &&
              widest < std::cos(half) + 0.01 * half * half + 1e-7);
    }
}

TEST(light_spot) {
    const double half = 0.6, blend = 0.4;
    const float cosHalf = static_cast<float>(std::cos(half));
    const SpotCone cone{{0, 0, -1}, cosHalf, static_cast<float>(blend), false};
    const PointLight spot({0, 0, 1}, kWhite, {}, 0, cone, true);
    const auto at = [&](double angle) { // on a circle of radius 1 around the lamp
        return static_cast<double>(spot.centre({static_cast<float>(std::sin(angle)), 0,
                                                static_cast<float>(1 - std::cos(angle))})
                                       .irradiance.g);
    };
    CHECK_NEAR(at(0), 1, 1e-6);
    const double soft = (1 - std::cos(half)) * blend;
    CHECK_NEAR(at(std::acos(std::cos(half) + soft) - 0.001), 1, 1e-5);
    CHECK_NEAR(at(std::acos(std::cos(half) + soft / 2)), 0.5, 1e-5);
    CHECK_NEAR(at(std::acos(std::cos(half) + soft / 4)), 0.15625, 1e-5); // 3/16 - 2/64
    CHECK_EQUAL(at(half + 0.001), 0.0);
    CHECK_EQUAL(at(kPi), 0.0);
    double last = 2;
    for (int i = 0; i <= 100; ++i) { // falls, never rises
        const double now = at(half * i / 100);
        CHECK(now <= last + 1e-6);
        last = now;
    }
    const SpotCone hard{{0, 0, -1}, cosHalf, 0, false}, old{{0, 0, -1}, cosHalf, 0, true};
    CHECK_EQUAL(hard.attenuation({std::sin(0.59f), 0, -std::cos(0.59f)}), 1.0f);
    CHECK_EQUAL(hard.attenuation({std::sin(0.61f), 0, -std::cos(0.61f)}), 0.0f);
    CHECK_NEAR(old.attenuation({std::sin(0.5f), 0, -std::cos(0.5f)}), std::cos(0.5), 1e-6);
}

// Spread: the emission is narrowed to a cone and gets brighter, so that the lamp's power, pi L A,
// stays: the integral over the hemisphere of what arrives from a far small lamp, times cos.
TEST(light_spread) {
    for (const double half : {0.1, 0.5, 1.0, 1.4}) {
        const FlatLight light = flat(FlatLight::Outline::Rectangle, {0, 0, 0}, half);
        double power = 0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double angle = kHalfPi * (i + 0.5) / steps;
            const Vec3 p{static_cast<float>(100 * std::sin(angle)), 0,
                         static_cast<float>(-100 * std::cos(angle))};
            const LightSample s = light.centre(p);
            if (angle > half + 1e-3) CHECK(isBlack(s.irradiance));
            // Irradiance at distance 100 is intensity / 100^2.
            power += static_cast<double>(s.irradiance.g) * 1e4 * kTwoPi * std::sin(angle) *
                     kHalfPi / steps;
        }
        CHECK_NEAR(power / (kPi * 0.5), 1, 1e-3);
    }
    // 180 degrees are no spread.
    const FlatLight wide = flat(FlatLight::Outline::Rectangle, {0, 0, 1}),
                    half = flat(FlatLight::Outline::Rectangle, {0, 0, 1}, kHalfPi);
    CHECK(wide.centre({1, 1, 0}).irradiance == half.centre({1, 1, 0}).irradiance);
}

namespace {

// Lamps of every kind somewhere about the origin, of every size.
std::unique_ptr<const Light> randomLamp(Random& random) {
    const Vec3 place = toFloat(random.inBox(3));
    const Vec3 way = toFloat(random.direction());
    const auto size = static_cast<float>(random.logUniform(1e-3, 3));
    const std::uint32_t kind = random.below(6);
    if (kind == 0)
        return std::make_unique<PointLight>(place, kWhite, Attenuation{}, 0, std::nullopt, true);
    if (kind == 1)
        return std::make_unique<PointLight>(place, kWhite, Attenuation{}, size, std::nullopt, true);
    if (kind == 2) {
        const SpotCone cone{way, static_cast<float>(random.uniform(-0.5, 1)),
                            static_cast<float>(random.unit())};
        return std::make_unique<PointLight>(place, kWhite, Attenuation{},
                                            random.chance(0.5) ? 0 : size, cone, true);
    }
    if (kind == 3)
        return std::make_unique<SunLight>(
            way, kWhite, random.chance(0.5) ? 0 : random.logUniform(1e-3, 3.1), true);
    if (kind == 4) return std::make_unique<SphereLight>(place, size, kWhite, true);
    const Vec3d x = random.direction(), y = cross(x, random.direction());
    return std::make_unique<FlatLight>(
        random.chance(0.5) ? FlatLight::Outline::Rectangle : FlatLight::Outline::Ellipse, place,
        toFloat(x) * size, toFloat(y), toFloat(normalize(cross(x, y))), kWhite, kHalfPi, true);
}

} // namespace

// cannotReach() is said only where no sample gives light to that normal, down to grazing ones, and
// mostly where it could be said.
TEST(light_cannot_reach_what_stays_dark) {
    Random random(72);
    int said = 0, dark = 0;
    for (int i = 0; i < check::scaled(20000); ++i) {
        const std::unique_ptr<const Light> lamp = randomLamp(random);
        const Vec3 p = toFloat(random.inBox(3));
        // Half of the normals are level with the lamp's centre, to a few units of rounding.
        Vec3d n = random.direction();
        const LightSample centre = lamp->centre(p);
        if (random.chance(0.5) && centre.distance > 0) {
            const Vec3d to = toDouble(centre.toLight);
            n = cross(n, to) + to * (random.uniform(-1, 1) * random.logUniform(1e-8, 1e-3));
        }
        const Vec3 normal = toFloat(normalize(n));
        bool isDark = true;
        for (int k = 0; k < 12; ++k) {
            const LightSample s = k == 0 ? centre : lamp->sample(p, random.square());
            isDark &= isBlack(s.irradiance) || !(dot(normal, s.toLight) > 0);
        }
        dark += isDark;
        if (!lamp->cannotReach(p, normal)) continue;
        ++said;
        CHECK_INFO(isDark, "case " << i << " of seed 72");
    }
    CHECK_INFO(said > dark * 2 / 3, said << " of " << dark);
}

// The line of a sample's light ends in the box that is said to hold its sources, not before the
// sample does.
TEST(light_sources_are_in_their_box) {
    Random random(73);
    for (int i = 0; i < check::scaled(20000); ++i) {
        const std::unique_ptr<const Light> lamp = randomLamp(random);
        const Vec3 p = toFloat(random.inBox(3));
        const LightSample s =
            random.chance(0.2) ? lamp->centre(p) : lamp->sample(p, random.square());
        if (isBlack(s.irradiance)) continue;
        Bounds points{p, p};
        points.extend(p + toFloat(random.inBox(0.5)));
        const Bounds box = lamp->sourcesFor(points, 1).padded(1e-5f);
        float enter = 0, leave = kInfinityF;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float a = (box.lo[axis] - p[axis]) / s.toLight[axis],
                        b = (box.hi[axis] - p[axis]) / s.toLight[axis];
            enter = max(min(a, b), enter);
            leave = min(max(a, b), leave);
        }
        CHECK_INFO(enter <= leave * 1.00001f, "case " << i << " of seed 73");
        if (s.distance < kInfinityF)
            CHECK_INFO(s.distance <= leave * 1.00001f, "case " << i << " of seed 73");
        else // a sun: outside of the scene
            CHECK_INFO(leave > 2 + maxAbs(p), "case " << i << " of seed 73");
    }
}

} // namespace test_light
