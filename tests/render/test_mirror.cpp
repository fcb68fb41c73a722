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

// The mean of a rough mirror under a white sky, seen straight on: its lobe is cos^n of the angle of
// the half vector, and N.L of the light remains: E[max(cos 2a, 0)]. A lamp overhead shows how wide
// it is: the part of the lobe within its cone.
TEST(glossyReflectionEnergyAndWidth) {
    for (const double r : {0.1, 0.3, 0.5, 0.8, 1.0}) {
        const double n = std::max(2 / (r * r * r * r) - 2, 1.0);
        const shot::TopView view{
            .pixels = 32, .side = 1e-3, .height = 0.5, .samples = 64, .more = "sampler random"};
        const std::string rough =
            cat("material rough {\n diffuse 0 0 0\n mirror 1 1 1\n roughness ", r,
                "\n}\nplane f {\n scale 9 9 1\n material rough\n}\n");
        const shot::Estimate sky = shot::estimate(
            shot::render(view.text() + rough + "world {\n background 1 1 1\n}\n").color);
        // Of the half vectors up to the angle with the cosine c.
        const auto within = [&](double c) {
            return 2 * (n + 1) / (n + 3) * (1 - std::pow(c, n + 3)) - (1 - std::pow(c, n + 1));
        };
        CHECK_NEAR(sky.mean, within(std::sqrt(0.5)), 3 * sky.sigma + 1e-6);

        const double cone = 2 * std::acos(std::pow(0.5, 1 / (n + 1))); // half of the half vectors
        const shot::Estimate lamp =
            shot::estimate(shot::render(view.text() + rough +
                                        "material glow {\n diffuse 0 0 0\n emission 1 1 1\n}\n" +
                                        cat("disk d {\n translate 0 0 1\n radius ",
                                            shortest(std::tan(cone)), "\n material glow\n}\n"))
                               .color);
        if (cone < 1.2) CHECK_NEAR(lamp.mean, within(std::cos(cone / 2)), 3 * lamp.sigma + 1e-5);
        CHECK(lamp.sigma < 0.01);
    }
}

// What a rough mirror reflects of a white sky, seen from the side: the integral of its lobe over
// the hemisphere, by the midpoint rule. What it draws below the horizon has no place there.
TEST(roughMirrorsSeenFromTheSide) {
    for (const double r : {0.5, 0.8, 1.0})
        for (const double degrees : {30.0, 60.0, 80.0, 87.0}) {
            const double n = std::max(2 / (r * r * r * r) - 2, 1.0), eye = radians(degrees);
            const Vec3d v{std::sin(eye), 0, std::cos(eye)};
            constexpr int kSteps = 400;
            double wanted = 0;
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps; ++j) {
                    const double z = (i + 0.5) / kSteps, turn = 2 * kPi * (j + 0.5) / kSteps;
                    const double side = std::sqrt(1 - z * z);
                    const Vec3d l{side * std::cos(turn), side * std::sin(turn), z};
                    const Vec3d h = normalize(v + l);
                    wanted += (n + 1) / (8 * kPi) * std::pow(h.z, n) /
                              (dot(h, v) * std::max(z, v.z)) * z * 2 * kPi / (kSteps * kSteps);
                }
            const shot::Shot shot = shot::render(
                cat("settings {\n resolution 24 24\n samples 64\n sampler random\n max_depth 1\n}\n"
                    "world {\n background 1 1 1\n}\ncamera c {\n lens 1e5\n look_at ",
                    shortest(v.x), " 0 ", shortest(v.z),
                    "  0 0 0  0 1 0\n}\nmaterial m {\n diffuse 0 0 0\n mirror 1 1 1\n roughness ",
                    r, "\n}\ninfinite_plane p {\n material m\n}\n"));
            const shot::Estimate seen = shot::estimate(shot.color);
            // 1e-3: the midpoint rule across the kink where N.L is N.V.
            CHECK_NEAR(seen.mean, wanted, 3.5 * seen.sigma + 1e-3);
        }
}

} // namespace test_mirror
