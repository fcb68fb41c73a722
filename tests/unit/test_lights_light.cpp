// How much light all of a lamp gives, by the mean of its samples: closed forms, and places that
// lamps are not made for.
#include "check.h"
#include "verify/light_kit.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

namespace test_lights_light {

using namespace light_kit;
using meshes::Random;

namespace {

double length2(Vec3d v) { return dot(v, v); }

// The mean over n x n strata of irradiance times direction, whose product with the normal of a
// surface that sees all of the lamp is what it gets; and the standard deviation of the mean, as
// that of n^2 random places at most.
struct Vector {
    Vec3d mean;
    double deviation;
    double variance; // of a sample's irradiance, over the square of its mean
};
Vector vectorOf(const OneLight& light, Vec3 p, int side, Random& random) {
    Vec3d sum;
    double squares = 0, total = 0;
    for (int i = 0; i < side * side; ++i) {
        const Vec2 place = random.square();
        const float u = (static_cast<float>(i / side) + place.x) / static_cast<float>(side);
        const float v = (static_cast<float>(i % side) + place.y) / static_cast<float>(side);
        const Sample s = light.sample(p, {min(u, kOneMinusUlp), min(v, kOneMinusUlp)});
        const auto e = static_cast<double>(s.irradiance.r);
        sum += toDouble(s.toLight) * e;
        squares += e * e, total += e;
    }
    const double n = side * side, mean = total / n;
    return {sum * (1 / n), std::sqrt(squares) / n, mean > 0 ? squares / n / (mean * mean) - 1 : 0};
}

// Lambert 1760: of a polygon of radiance 1 that shines to the point.
Vec3d ofPolygon(const std::vector<Vec3d>& corners, Vec3d p) {
    Vec3d sum, middle;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = corners[i] - p, b = corners[(i + 1) % corners.size()] - p;
        const Vec3d across = cross(a, b);
        const double sine = length(across);
        if (sine > 0) sum += across * (std::atan2(sine, dot(a, b)) / sine);
        middle += a;
    }
    return sum * (dot(sum, middle) < 0 ? -0.5 : 0.5);
}

// By places on a grid: fn(x, y) is the place for x and y in [-1,1], `n` the normal.
Vec3d byPlaces(const std::function<Vec3d(double, double)>& at, Vec3d n, double area, Vec3d p,
               bool isRound, const std::function<double(double)>& spread) {
    constexpr int kSide = 300;
    Vec3d sum;
    int inside = 0;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            double x = (2 * i + 1.0) / kSide - 1, y = (2 * j + 1.0) / kSide - 1;
            if (isRound) { // rings of equal area
                const double r = std::sqrt((x + 1) / 2), turn = kPi * y;
                x = r * std::cos(turn), y = r * std::sin(turn);
            }
            ++inside;
            const Vec3d d = at(x, y) - p;
            const double distance2 = length2(d), distance = std::sqrt(distance2);
            const double cosine = -dot(d, n) / distance;
            if (cosine > 0) sum += d * (spread(cosine) * cosine / (distance2 * distance));
        }
    }
    return sum * (area / inside);
}

} // namespace

// 48 x 48 strata against Lambert's formula, and grids of places where there is none. Bounds are six
// deviations of random places, which strata stay far below, and what the grids are off.
TEST(lights_give_what_closed_forms_give) {
    constexpr std::uint64_t kSeed = 5104;
    Random random(kSeed);
    const auto compare = [&](const OneLight& light, Vec3 p, Vec3d expected, double slack,
                             const char* what) {
        const Vector v = vectorOf(light, p, 48, random);
        const double off = length(v.mean - expected);
        CHECK_INFO(off <= 3 * v.deviation * std::sqrt(min(v.variance + 1e-3, 1.0)) +
                              slack * length(expected) + 1e-9,
                   "seed " << kSeed << ' ' << what << ": off by " << off << " of "
                           << length(expected) << ", deviation " << v.deviation << " variance "
                           << v.variance);
        return v;
    };
    for (int i = 0; i < 60; ++i) {
        const Vec3 centre = toFloat(random.inBox(1));
        const auto size = static_cast<float>(random.logUniform(0.02, 3));
        auto rectangle = flat<RectangleRow>(random, centre, size);
        Vec3 p = toFloat(random.inBox(2));
        if (dot(p - centre, rectangle.normal) < 0) rectangle.normal = -rectangle.normal;
        const Vec3d c = toDouble(centre), x = toDouble(rectangle.halfX),
                    y = toDouble(rectangle.halfY);
        compare(OneLight(rectangle), p,
                ofPolygon({c - x - y, c + x - y, c + x + y, c - x + y}, toDouble(p)), 1e-6,
                "rectangle");

        const TriangleRow triangle = light_kit::triangle(random, centre, size);
        compare(OneLight(triangle), p,
                ofPolygon({toDouble(triangle.a), toDouble(triangle.b), toDouble(triangle.c)},
                          toDouble(p)),
                1e-6, "triangle");

        const double spread = random.uniform(0.3, 1.5);
        for (const bool spreads : {false, true}) {
            if (spreads) setSpread(rectangle, spread);
            const double norm = 1 / (std::tan(spread) - spread);
            const auto part = [&](double cosine) {
                if (!spreads) return 1.0;
                const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
                return max((std::tan(spread) - tangent) * norm, 0.0);
            };
            const auto at = [&](double s, double t) { return c + x * s + y * t; };
            const Vec3d n = toDouble(rectangle.normal);
            // Grids of 300 x 300 are good where the lamp is not much nearer than it is large.
            if (length(p - centre) < size) continue;
            const double area = length(x) * length(y);
            const DiskRow disk{{rectangle}};
            if (spreads)
                compare(OneLight(rectangle), p, byPlaces(at, n, 4 * area, toDouble(p), false, part),
                        4e-3, "rectangle with a spread");
            const Vector v =
                compare(OneLight(disk), p, byPlaces(at, n, kPi * area, toDouble(p), true, part),
                        4e-3, spreads ? "disk with a spread" : "disk");
            if (!spreads) CHECK_INFO(v.variance < 0.15, "a disk's samples vary by " << v.variance);
        }

        const SphereRow sphere = light_kit::sphere(centre, size);
        const Vec3d d = c - toDouble(p);
        if (length(d) > static_cast<double>(size) * 1.001)
            compare(OneLight(sphere), p,
                    d * (kPi * sqr(static_cast<double>(size)) / (length2(d) * length(d))), 1e-6,
                    "sphere");
        else
            compare(OneLight(sphere), p, {}, 1e-3, "sphere from within");
        // A disk that faces the point: I / (D^2 + r^2).
        compare(OneLight(light_kit::point(centre, size)), p,
                d * (1 / ((length2(d) + sqr(static_cast<double>(size))) * length(d))), 1e-6,
                "point's disk");
        const SunRow sun = light_kit::sun(random, random.logUniform(1e-4, 1.5));
        // All of a disk in the sky: the surface that faces its middle has this irradiance.
        compare(OneLight(sun), p, toDouble(sun.toSun), 1e-6, "sun");
    }
}

// Above its middle a disk of radius a gives pi a^2 / (a^2 + h^2); a point nearly on a large lamp
// gets pi times the radiance, and the samples of a rectangle vary with the cosine only.
TEST(lights_near_their_surface) {
    constexpr std::uint64_t kSeed = 5105;
    Random random(kSeed);
    for (const float h : {1e-6f, 1e-4f, 1e-2f, 0.1f, 1.0f, 10.0f}) {
        DiskRow disk;
        disk.halfX = {1, 0, 0}, disk.halfY = {0, 1, 0}, disk.normal = {0, 0, 1};
        disk.radiance = {1, 1, 1};
        const auto h2 = static_cast<double>(h) * static_cast<double>(h);
        const Vector round = vectorOf(OneLight(disk), {0, 0, h}, 64, random);
        CHECK_INFO(std::fabs(-round.mean.z / (kPi / (1 + h2)) - 1) < 2e-3,
                   "disk from " << h << ": " << -round.mean.z << " variance " << round.variance);
        CHECK_INFO(round.variance < 0.5, h << ' ' << round.variance);
        const RectangleRow rectangle{{disk}};
        for (const Vec2 at : {Vec2{}, Vec2{0.5f, 0.9f}}) {
            const Vec3 p{at.x, at.y, h};
            const Vector v = vectorOf(OneLight(rectangle), p, 64, random);
            const Vec3d expected =
                ofPolygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, toDouble(p));
            CHECK_INFO(length(v.mean - expected) < 3e-3 * length(expected), "rectangle from " << h);
            CHECK_INFO(v.variance < 1e-6 || h >= 10, "rectangle from " << h << ' ' << v.variance);
        }
    }
}

// On the lamp's plane, in it, at its corners and centre, 1e-6 to 1e6 times its size away, with the
// ends of the unit square; and lamps without an area, which are black. No number is none.
TEST(lights_in_hard_places) {
    constexpr std::uint64_t kSeed = 5106;
    Random random(kSeed);
    const float ends[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, kOneMinusUlp};
    const auto finite = [](float x) { return std::fabs(x) < kInfinityF; };
    const auto look = [&](const OneLight& light, Vec3 p, bool isBlackLamp) {
        const auto check = [&](const Sample& s, const char* what) {
            const Rgb e = s.irradiance;
            const bool sound = finite(e.r) && finite(e.g) && finite(e.b) && e.r >= 0 && e.g >= 0 &&
                               finite(s.pdf) && s.pdf >= 0 && s.distance >= 0 &&
                               std::fabs(length(toDouble(s.toLight)) - 1) < 1e-6;
            CHECK_INFO(sound, "seed " << kSeed << ' ' << light.name() << ' ' << what << " at "
                                      << p.x << ' ' << p.y << ' ' << p.z << ": " << e.r << " pdf "
                                      << s.pdf << " distance " << s.distance << " length "
                                      << length(toDouble(s.toLight)));
            if (isBlackLamp) CHECK_INFO(isBlack(e), light.name() << ' ' << what << " isn't black");
            const float pdf = light.pdf(p, s.toLight);
            CHECK_INFO(finite(pdf) && pdf >= 0, light.name() << " has a pdf of " << pdf);
            const auto m = light.meet(p, s.toLight);
            CHECK_INFO(m.distance >= 0 && finite(m.radiance.r) && m.radiance.r >= 0,
                       light.name() << " is met at " << m.distance << ' ' << m.radiance.r);
        };
        for (const float u : ends)
            for (const float v : ends) check(light.sample(p, {u, v}), "sample");
        check(light.centre(p), "centre");
    };
    for (int i = 0; i < 150; ++i) {
        const auto size = static_cast<float>(random.logUniform(1e-6, 1e6));
        const Vec3 centre = toFloat(random.inBox(1));
        const auto rectangle = flat<RectangleRow>(random, centre, size);
        const DiskRow disk{{rectangle}};
        const TriangleRow triangle = light_kit::triangle(random, centre, size);
        std::vector<Vec3> points = {centre,
                                    centre + rectangle.halfX,
                                    centre + rectangle.halfX + rectangle.halfY,
                                    centre + rectangle.halfX * 3.0f,
                                    centre + rectangle.halfX + rectangle.normal * (size * 1e-6f),
                                    centre + rectangle.normal * (size * 1e-6f),
                                    triangle.a,
                                    triangle.b,
                                    (triangle.a + triangle.b) * 0.5f,
                                    (triangle.a + triangle.b + triangle.c) * (1.0f / 3),
                                    triangle.a * 2.0f - triangle.b};
        for (const float away : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f})
            points.push_back(centre + toFloat(random.direction()) * (size * away));
        for (const Vec3 p : points) {
            look(OneLight(rectangle), p, false), look(OneLight(disk), p, false);
            look(OneLight(triangle), p, false);
            look(OneLight(light_kit::sphere(centre, size)), p, false);
            look(OneLight(light_kit::point(centre, size)), p, false);
            look(OneLight(light_kit::spot(random, centre, size)), p, false);
            look(OneLight(light_kit::sun(random, random.logUniform(1e-9, 1.5))), p, false);
        }
    }
    for (int i = 0; i < 50; ++i) {
        const Vec3 centre = toFloat(random.inBox(1)), p = toFloat(random.inBox(1));
        auto line = flat<RectangleRow>(random, centre, 1);
        line.halfY = {};
        look(OneLight(line), p, true), look(OneLight(DiskRow{{line}}), p, true);
        TriangleRow needle = light_kit::triangle(random, centre, 1);
        needle.c = needle.b;
        look(OneLight(needle), p, true);
        needle.c = needle.b = needle.a;
        look(OneLight(needle), p, true);
        look(OneLight(light_kit::sphere(centre, 0)), p, true);
        look(OneLight(light_kit::sphere(centre, 0)), centre, true);
        look(OneLight(light_kit::point(centre, 0)), centre, true);
    }
}

} // namespace test_lights_light
