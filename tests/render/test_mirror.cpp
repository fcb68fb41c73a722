// Mirrors, sharp and rough, by sums and powers of what they reflect.
#include "check.h"
#include "shot.h"

namespace test_mirror {

namespace {

constexpr const char* kMirror = "material m {\n diffuse 0 0 0\n mirror 0.9 0.8 0.7\n}\n";

} // namespace

// Between two mirrors that face each other and glow: e (1 + k + ... + k^depth).
TEST(mirrorPairSumsToItsDepth) {
    for (const int depth : {0, 1, 5, 12}) {
        const shot::Shot shot = shot::render(
            cat(shot::kOnePixel, depth,
                "\n}\ncamera c {\n look_at 0 0 0  1 0 0  0 0 1\n}\n"
                "material m {\n diffuse 0 0 0\n emission 1 1 1\n mirror 0.9 0.8 0.7\n}\n"
                "plane a {\n translate 1 0 0\n rotate -90 0 1 0\n material m\n}\n"
                "plane b {\n translate -1 0 0\n rotate 90 0 1 0\n material m\n}\n"));
        const auto sum = [&](double k) { return (1 - std::pow(k, depth + 1)) / (1 - k); };
        CHECK_RGB(shot.at(0, 0), (Vec3d{sum(0.9), sum(0.8), sum(0.7)}), 1e-6); // 13 additions
        CHECK_EQUAL(shot.stats.rays.reflect, static_cast<std::uint64_t>(depth));
    }
}

// n reflections in a zigzag up between two mirrors, then the sky: ks^n, and nothing below n
// bounces.
TEST(mirrorPairPowers) {
    for (const int n : {1, 2, 5, 8})
        for (const int depth : {4, 8}) {
            const shot::Shot shot = shot::render(
                cat(shot::kOnePixel, depth, "\n}\nworld {\n background 1 1 1\n}\n", kMirror,
                    "camera c {\n look_at 0 0 0  1 0 1  0 1 0\n}\n"
                    "cube a {\n translate 2 0 0\n scale 1 1 ",
                    2 * n,
                    "\n material m\n}\n"
                    "cube b {\n translate -2 0 0\n scale 1 1 ",
                    2 * n, "\n material m\n}\n"));
            const auto k = [&](double ks) { return n <= depth ? std::pow(ks, n) : 0; };
            CHECK_RGB(shot.at(0, 0), (Vec3d{k(0.9), k(0.8), k(0.7)}), 1e-6); // 8 multiplications
        }
}

// A rough mirror of white metal under a white sky sends back all of it, seen straight on and from
// the side, to the 1.5 % of the tables of what facets lose.
TEST(roughMirrorsKeepTheLight) {
    for (const double r : {0.1, 0.3, 0.5, 0.8, 1.0})
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 87.0}) {
            const double eye = radians(degrees);
            const shot::Shot shot = shot::render(
                cat("settings {\n resolution 24 24\n samples 64\n sampler random\n max_depth 1\n}\n"
                    "world {\n background 1 1 1\n}\ncamera c {\n lens 1e5\n look_at ",
                    shortest(std::sin(eye)), " 0 ", shortest(std::cos(eye)),
                    "  0 0 0  0 1 0\n}\nmaterial m {\n diffuse 0 0 0\n mirror 1 1 1\n roughness ",
                    r, "\n}\ninfinite_plane p {\n material m\n}\n"));
            const shot::Estimate seen = shot::estimate(shot.color);
            CHECK_NEAR(seen.mean, 1, 3.5 * seen.sigma + 0.015);
        }
}

// How wide a rough mirror is: seen straight on, facets lean by less than atan(alpha), alpha the
// square of the roughness, in half of what it reflects (GGX, Walter et al. 2007). A disk overhead
// has as much of it; the part alpha^2 / (1 + alpha^2) that facets would send below the horizon, and
// less than half as much that they hide from each other, is given back to all directions.
TEST(roughMirrorsAreAsWideAsGgx) {
    for (const double r : {0.1, 0.3, 0.5}) {
        const shot::TopView view{
            .pixels = 32, .side = 1e-3, .height = 0.5, .samples = 64, .more = "sampler random"};
        const double half = 2 * std::atan(r * r); // of the cone of reflected directions
        const shot::Estimate lamp = shot::estimate(
            shot::render(view.text() +
                         cat("material rough {\n diffuse 0 0 0\n mirror 1 1 1\n roughness ", r,
                             "\n}\nplane f {\n scale 9 9 1\n material rough\n}\n") +
                         "material glow {\n diffuse 0 0 0\n emission 1 1 1\n}\n" +
                         cat("disk d {\n translate 0 0 1\n radius ", shortest(std::tan(half)),
                             "\n material glow\n}\n"))
                .color);
        const double alpha2 = r * r * r * r;
        CHECK_NEAR(lamp.mean, 0.5 * (1 + alpha2), 3 * lamp.sigma + 0.25 * alpha2);
        CHECK(lamp.sigma < 0.01);
    }
}

} // namespace test_mirror
