// Lamps against closed forms: what arrives, from where, and in which pattern.
#include "base/math.h"
#include "check.h"
#include "light/area_light.h"
#include "light/point_light.h"
#include "light/sun_light.h"
#include "verify/meshes.h"

using meshes::Random;

namespace {

constexpr Rgb kWhite{1, 1, 1};

// Irradiance on a surface at `point` with normal n: the mean over n x n strata with random places.
struct Estimate {
    double mean = 0, sigma = 0; // sigma of the mean, for independent samples
};
Estimate irradiance(const Light& light, Vec3 point, Vec3 n, int side, std::uint64_t seed,
                    bool stratified) {
    Random random(seed);
    double sum = 0, sum2 = 0;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            Vec2 u = random.square();
            if (stratified) {
                u = {static_cast<float>((i + static_cast<double>(u.x)) / side),
                     static_cast<float>((j + static_cast<double>(u.y)) / side)};
                u = {min(u.x, kOneMinusUlp), min(u.y, kOneMinusUlp)};
            }
            const LightSample s = light.sample(point, u);
            const double e = max(static_cast<double>(dot(s.toLight, n)), 0.0) *
                             static_cast<double>(s.irradiance.g);
            sum += e, sum2 += e * e;
        }
    }
    const double count = static_cast<double>(side) * side, mean = sum / count;
    return {mean, std::sqrt(max(sum2 / count - mean * mean, 0.0) / count)};
}

// Lambert 1760: E = L/2 sum of angle_i (edge normal_i . n) for a polygon above the horizon.
double polygonIrradiance(const std::vector<Vec3d>& corners, Vec3d point, Vec3d n) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = normalize(corners[i] - point);
        const Vec3d b = normalize(corners[(i + 1) % corners.size()] - point);
        const double angle = std::acos(clamp(dot(a, b), -1.0, 1.0));
        sum += angle * dot(normalize(cross(a, b)), n);
    }
    return std::fabs(sum) / 2;
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
    const Estimate e = irradiance(light, {0, 0, 0}, {0, 0, 1}, 64, 72, true);
    CHECK_NEAR(e.mean, 1 / (0.25 + 4), 1e-4);
    CHECK_NEAR(light.centre({0, 0, 0}).irradiance.g, 0.25, 1e-7);
}

TEST(light_disk_on_axis) {
    for (const double h : {0.1, 0.5, 1.0, 4.0}) {
        const FlatLight light(FlatLight::Outline::Ellipse, {0, 0, static_cast<float>(h)},
                              {0.5f, 0, 0}, {0, 0.5f, 0}, {0, 0, -1}, kWhite, kHalfPi, true);
        const double exact = kPi * 0.25 / (0.25 + h * h);
        const Estimate random = irradiance(light, {}, {0, 0, 1}, 200, 73, false);
        CHECK_NEAR(random.mean, exact, 3 * random.sigma);
        const Estimate even = irradiance(light, {}, {0, 0, 1}, 200, 74, true);
        CHECK_NEAR(even.mean, exact, 1e-3 * exact);
        CHECK(isBlack(
            light.sample({0, 0, static_cast<float>(h) * 2}, {0.3f, 0.3f}).irradiance)); // behind
    }
    // An ellipse has the area pi a b, from afar: E = L A / h^2.
    const FlatLight ellipse = flat(FlatLight::Outline::Ellipse, {0, 0, 100});
    const double far = kPi * 0.125 / 1e4;
    CHECK_NEAR(irradiance(ellipse, {}, {0, 0, 1}, 50, 75, true).mean, far, 1e-4 * far);
    CHECK_NEAR(ellipse.centre({}).irradiance.g, far, 1e-6 * far);
}

TEST(light_rectangle_form_factor) {
    Random random(76);
    double worst = 0;
    for (int i = 0; i < 40; ++i) {
        const FlatLight light = flat(FlatLight::Outline::Rectangle, {0, 0, 1});
        const std::vector<Vec3d> corners = {
            {-0.5, -0.25, 1}, {0.5, -0.25, 1}, {0.5, 0.25, 1}, {-0.5, 0.25, 1}};
        const Vec3d point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.5, 0.5)};
        // A normal that has all of the lamp above its horizon.
        Vec3d n = normalize(Vec3d{0, 0, 1} - point) + random.direction() * 0.4;
        bool above = true;
        for (const Vec3d c : corners) above = above && dot(c - point, n) > 0;
        if (!above) continue;
        n = normalize(n);
        const double exact = polygonIrradiance(corners, toDouble(toFloat(point)), n);
        const Estimate e = irradiance(light, toFloat(point), toFloat(n), 100,
                                      7600 + static_cast<std::uint64_t>(i), true);
        worst = max(worst, std::fabs(e.mean / exact - 1));
        const Estimate plain = irradiance(light, toFloat(point), toFloat(n), 100,
                                          7700 + static_cast<std::uint64_t>(i), false);
        CHECK_INFO(std::fabs(plain.mean - exact) < 4.5 * plain.sigma,
                   "case " << i << ": " << plain.mean << ", exact " << exact);
    }
    std::printf("rectangle: worst relative error %g, seed 76\n", worst);
    CHECK_INFO(worst < 1e-3, worst);
}

// E = pi L (r/d)^2 cos for a sphere that is all above the horizon, however near.
TEST(light_sphere) {
    for (const double d : {1.01, 1.5, 3.0, 100.0}) {
        const SphereLight light({0, 0, static_cast<float>(d)}, 1, kWhite, true);
        CHECK(light.isSoft());
        const double exact = kPi / sqr(static_cast<double>(static_cast<float>(d)));
        CHECK_NEAR(irradiance(light, {}, {0, 0, 1}, 100, 77, true).mean / exact, 1, 1e-3);
        CHECK_NEAR(light.centre({}).irradiance.g / exact, 1, 1e-5);
        if (d < 2) continue;
        const Vec3 tilted{0.6f, 0, 0.8f}; // the sphere fills 20 degrees at d = 3, so it is above
        CHECK_NEAR(irradiance(light, {}, tilted, 100, 78, true).mean / (0.8 * exact), 1, 1e-3);
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
    CHECK_NEAR(irradiance(light, {1.1f, 2.2f, 2.9f}, {0, 0, 1}, 100, 80, true).mean, kPi, 5e-3);
}

// The sun's irradiance does not depend on the size of its disk.
TEST(light_sun) {
    const Vec3 down{0, 0, -1};
    for (const double half : {0.0, 0.001, 0.0046, 0.1, 0.5, 1.5}) {
        const SunLight sun(down, {1, 2, 3}, half, true);
        CHECK_EQUAL(sun.isSoft(), half > 0);
        CHECK_NEAR(irradiance(sun, {5, 6, 7}, {0, 0, 1}, 60, 81, true).mean, 2, 2e-4);
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
