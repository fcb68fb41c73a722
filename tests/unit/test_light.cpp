// Lamps against closed forms: what arrives, from where, and in which pattern.
#include "base/math.h"
#include "check.h"
#include "verify/light_kit.h"

namespace test_light {

using namespace light_kit;
using meshes::Random;

namespace {

constexpr Rgb kWhite{1, 1, 1};

// Irradiance on a surface at `point` with normal n: the mean over n x n strata with random places.
double irradiance(const OneLight& light, Vec3 point, Vec3 n, int side, std::uint64_t seed) {
    Random random(seed);
    double sum = 0;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const Vec2 place = random.square();
            const Vec2 u{static_cast<float>((i + static_cast<double>(place.x)) / side),
                         static_cast<float>((j + static_cast<double>(place.y)) / side)};
            const Sample s = light.sample(point, {min(u.x, kOneMinusUlp), min(u.y, kOneMinusUlp)});
            sum += max(static_cast<double>(dot(s.toLight, n)), 0.0) *
                   static_cast<double>(s.irradiance.g);
        }
    }
    return sum / (static_cast<double>(side) * side);
}

PointRow whitePoint(Vec3 position) { return {position, kWhite}; }

template <class Row> Row whiteFlat(Vec3 centre, double spreadHalfRad = kHalfPi) {
    Row row;
    row.centre = centre, row.halfX = {0.5f, 0, 0}, row.halfY = {0, 0.25f, 0};
    row.normal = {0, 0, -1}, row.radiance = kWhite;
    setSpread(row, spreadHalfRad);
    return row;
}

} // namespace

TEST(light_point_inverse_square) {
    const OneLight light(PointRow{{1, 2, 3}, {2, 4, 8}});
    Random random(71);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = toFloat(random.inBox(5));
        const Vec3d d = Vec3d{1, 2, 3} - toDouble(p);
        const double r2 = dot(d, d);
        for (const Sample& s : {light.centre(p), light.sample(p, random.square())}) {
            CHECK_NEAR(s.irradiance.r * r2, 2, 2e-6);
            CHECK_NEAR(s.irradiance.b * r2, 8, 8e-6);
            CHECK_NEAR(s.distance, std::sqrt(r2), 2e-6);
            CHECK(length(toDouble(s.toLight) - normalize(d)) < 1e-6);
            CHECK(s.single && s.pdf == 0);
        }
    }
    CHECK(isBlack(light.centre({1, 2, 3}).irradiance)); // in the lamp: nothing, and no NaN
}

// I / (a d^2 + b d + c), also with the disk of a soft light seen from afar.
TEST(light_point_attenuation) {
    Random random(77);
    for (int i = 0; i < 300; ++i) {
        PointRow row{{}, kWhite * 3.0f};
        row.attenuation = {static_cast<float>(random.unit()), static_cast<float>(random.unit()),
                           static_cast<float>(random.unit())};
        const Vec3 p = toFloat(random.inBox(20) + Vec3d{25, 0, 0});
        const Vec3d fade = toDouble(row.attenuation);
        const double d = length(toDouble(p)), expected = 3 / (fade.x * d * d + fade.y * d + fade.z);
        CHECK_NEAR(OneLight(row).centre(p).irradiance.g, expected, 1e-6 * expected);
        row.radius = 1e-3f;
        const float soft = OneLight(row).sample(p, random.square()).irradiance.g;
        CHECK_NEAR(soft, expected, 1e-5 * expected); // (radius / d)^2 = 4e-6 at most
    }
}

// The disk of a soft light faces the receiver, so that a cone darkens its places one by one, and
// the light in its centre is that of a hard one.
TEST(light_soft_point_is_a_disk) {
    PointRow row = whitePoint({0, 0, 2});
    row.radius = 0.5f;
    const OneLight light(row);
    CHECK_NEAR(irradiance(light, {}, {0, 0, 1}, 64, 72), 1 / (0.25 + 4), 1e-4);
    CHECK_NEAR(light.centre({}).irradiance.g, 0.25, 1e-7);
    const SpotRow spot{row, {0, 0, -1}, static_cast<float>(std::cos(std::atan(0.125))), 0, 0};
    // The inner half of the radius, seen within the cone: of c^4 r dr, with c the cosine.
    const double within = (1 - 1 / (1 + sqr(0.125))) / (1 - 1 / (1 + sqr(0.25)));
    CHECK_NEAR(irradiance(OneLight(spot), {}, {0, 0, 1}, 200, 73), within / (0.25 + 4), 1e-3);
}

// Lamps as if they sat in their centres: the intensity towards the point over the square of the
// distance. Behind what shines to one side it is dark.
TEST(light_of_centres) {
    constexpr std::uint64_t kSeed = 74;
    Random random(kSeed);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 centre = toFloat(random.inBox(1)), p = toFloat(random.inBox(3));
        const Vec3d d = toDouble(centre) - toDouble(p);
        const double far2 = dot(d, d);
        if (far2 < 1e-2) continue;
        const auto check = [&](const OneLight& light, double expected, double most) {
            const Sample s = light.centre(p);
            CHECK_INFO(std::fabs(static_cast<double>(s.irradiance.r) - expected) <= 3e-6 * most &&
                           s.single && s.pdf == 0,
                       "seed " << kSeed << " case " << i << ' ' << light.name() << ' '
                               << s.irradiance.r << ", expected " << expected);
            if (expected > 0)
                CHECK_INFO(length(toDouble(s.toLight) - normalize(d)) < 1e-6, light.name());
        };
        const auto size = static_cast<float>(random.uniform(0.1, 1));
        const auto rectangle = flat<RectangleRow>(random, centre, size);
        const double cosine = -dot(d, toDouble(rectangle.normal)) / std::sqrt(far2);
        const double sides = length(toDouble(rectangle.halfX)) * length(toDouble(rectangle.halfY));
        check(OneLight(rectangle), 4 * sides * max(cosine, 0.0) / far2, 4 * sides / far2);
        const DiskRow disk{{rectangle}};
        check(OneLight(disk), kPi * sides * max(cosine, 0.0) / far2, kPi * sides / far2);
        if (cosine < -1e-6)
            for (const OneLight& light : {OneLight(rectangle), OneLight(disk)}) {
                const Sample s = light.sample(p, random.square());
                CHECK_INFO(isBlack(s.irradiance) && s.pdf == 0, light.name());
            }

        // About its centroid.
        TriangleRow triangle = light_kit::triangle(random, {}, size);
        const Vec3 shift = centre - (triangle.a + triangle.b + triangle.c) * (1.0f / 3);
        triangle.a = triangle.a + shift, triangle.b = triangle.b + shift,
        triangle.c = triangle.c + shift;
        triangle.isTwoSided = static_cast<float>(i % 2);
        const Vec3d across = cross(toDouble(triangle.b) - toDouble(triangle.a),
                                   toDouble(triangle.c) - toDouble(triangle.a));
        const double shown = -dot(d, across) / 2 / std::sqrt(far2); // area times cosine
        if (std::fabs(shown) > 1e-6)
            check(OneLight(triangle), max(shown, i % 2 == 1 ? -shown : 0.0) / far2,
                  length(across) / 2 / far2);

        const double radius = double{size};
        if (radius * radius < far2) {
            const OneLight sphere(light_kit::sphere(centre, size));
            check(sphere, kPi * radius * radius / far2, kPi * radius * radius / far2);
            CHECK_NEAR(sphere.centre(p).distance, std::sqrt(far2) - radius, 1e-6);
        }
        const SunRow sun = light_kit::sun(random, random.uniform(0, 1.5));
        const Sample s = OneLight(sun).centre(p);
        CHECK(s.irradiance == sun.irradiance && s.toLight == sun.toSun && s.single);
    }
}

// Samples are on the near side of the sphere; inside light comes from everywhere: E = pi L.
TEST(light_sphere) {
    const OneLight light(SphereRow{{1, 2, 3}, 0.5f, kWhite});
    Random random(79);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = toFloat(random.inBox(5));
        const Sample s = light.sample(p, random.square());
        const Vec3d end = toDouble(p) + toDouble(s.toLight) * static_cast<double>(s.distance);
        const double off = length(end - Vec3d{1, 2, 3}) - 0.5;
        const bool isInside = length(toDouble(p) - Vec3d{1, 2, 3}) < 0.5;
        // Where a direction grazes the sphere, its rounding counts by its square root.
        CHECK_INFO(std::fabs(off) < 1e-4, "off " << off);
        if (!isInside) CHECK(s.distance <= length(Vec3{1, 2, 3} - p));
    }
    CHECK_NEAR(irradiance(light, {1.1f, 2.2f, 2.9f}, {0, 0, 1}, 100, 80), kPi, 5e-3);
    for (const double d : {1.01, 1.5, 3.0, 100.0}) { // E = pi L (r/d)^2 straight on, however near
        const OneLight near(SphereRow{{0, 0, static_cast<float>(d)}, 1, kWhite});
        CHECK_NEAR(irradiance(near, {}, {0, 0, 1}, 100, 77) / (kPi / (d * d)), 1, 1e-3);
    }
}

// The sun's irradiance does not depend on the size of its disk, whose border is where it says.
TEST(light_sun) {
    for (const double half : {0.0, 0.001, 0.0046, 0.1, 0.5, 1.5}) {
        const OneLight sun(
            SunRow{{0, 0, 1}, {1, 2, 3}, static_cast<float>(2 * sqr(std::sin(half / 2)))});
        CHECK_NEAR(irradiance(sun, {5, 6, 7}, {0, 0, 1}, 60, 81), 2, 2e-4);
        Random random(82);
        double widest = 1;
        for (int i = 0; i < 1000; ++i) {
            const Sample s = sun.sample({}, random.square());
            CHECK(s.distance == kInfinityF && s.single == (half == 0));
            widest = min(widest, static_cast<double>(s.toLight.z));
            CHECK_NEAR(length(s.toLight), 1, 3e-7);
        }
        CHECK(widest >= std::cos(half) - 1e-6 &&
              widest < std::cos(half) + 0.01 * half * half + 1e-7);
    }
}

TEST(light_spot) {
    const double half = 0.6, blend = 0.4;
    SpotRow row{whitePoint({0, 0, 1}), {0, 0, -1}, static_cast<float>(std::cos(half))};
    const auto at = [&](double angle) { // on a circle of radius 1 around the lamp
        const Sample s = OneLight(row).centre(
            {static_cast<float>(std::sin(angle)), 0, static_cast<float>(1 - std::cos(angle))});
        return static_cast<double>(s.irradiance.g);
    };
    row.blend = static_cast<float>(blend);
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
    row.blend = 0; // a hard border
    CHECK_NEAR(at(0.59), 1, 1e-6);
    CHECK_EQUAL(at(0.61), 0.0);
    row.cosineFalloff = 1;
    CHECK_NEAR(at(0.5), std::cos(0.5), 1e-6);
    CHECK_EQUAL(at(0.61), 0.0);
}

// Spread: the emission is narrowed to a cone and gets brighter, so that the lamp's power, pi L A,
// stays: the integral over the hemisphere of what arrives from a far small lamp, times cos.
TEST(light_spread) {
    for (const double half : {0.1, 0.5, 1.0, 1.4}) {
        const OneLight light(whiteFlat<RectangleRow>({}, half));
        double power = 0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double angle = kHalfPi * (i + 0.5) / steps;
            const Vec3 p{static_cast<float>(100 * std::sin(angle)), 0,
                         static_cast<float>(-100 * std::cos(angle))};
            const Sample s = light.centre(p);
            if (angle > half + 1e-3) CHECK(isBlack(s.irradiance));
            // Irradiance at distance 100 is intensity / 100^2.
            power += static_cast<double>(s.irradiance.g) * 1e4 * kTwoPi * std::sin(angle) *
                     kHalfPi / steps;
        }
        CHECK_NEAR(power / (kPi * 0.5), 1, 1e-3);
    }
    // 180 degrees are no spread.
    const FlatRow half = whiteFlat<RectangleRow>({}, kHalfPi);
    CHECK(half.tanSpread == 0 && half.spreadNorm == 0);
}

} // namespace test_light
