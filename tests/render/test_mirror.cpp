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
// the half vector, and N.L of the light remains: E[cos 2a] = (n-1)/(n+3). A lamp overhead shows how
// wide it is: the part of the lobe within its cone.
TEST(glossyReflectionEnergyAndWidth) {
    for (const double r : {0.1, 0.3, 0.5}) {
        const double n = 2 / (r * r * r * r) - 2;
        const shot::TopView view{
            .pixels = 32, .side = 1e-3, .height = 0.5, .samples = 64, .more = "sampler random"};
        const std::string rough =
            cat("material rough {\n diffuse 0 0 0\n mirror 1 1 1\n roughness ", r,
                "\n}\nplane f {\n scale 9 9 1\n material rough\n}\n");
        const shot::Estimate sky = shot::estimate(
            shot::render(view.text() + rough + "world {\n background 1 1 1\n}\n").color);
        // Half vectors that send light below the plane (part 2^-(n+1)/2 of them) count as N.L > 0.
        CHECK_NEAR(sky.mean, (n - 1) / (n + 3),
                   3 * sky.sigma + 4 * std::pow(2, -(n + 1) / 2) + 1e-6);

        const double cone = 2 * std::acos(std::pow(0.5, 1 / (n + 1))); // half of the half vectors
        const shot::Estimate lamp =
            shot::estimate(shot::render(view.text() + rough +
                                        "material glow {\n diffuse 0 0 0\n emission 1 1 1\n}\n" +
                                        cat("disk d {\n translate 0 0 1\n radius ",
                                            shortest(std::tan(cone)), "\n material glow\n}\n"))
                               .color);
        const double c = std::cos(cone / 2);
        const double wanted =
            2 * (n + 1) / (n + 3) * (1 - std::pow(c, n + 3)) - (1 - std::pow(c, n + 1));
        if (cone < 1.2) CHECK_NEAR(lamp.mean, wanted, 3 * lamp.sigma + 1e-5);
        CHECK(lamp.sigma < 0.01);
    }
}

} // namespace test_mirror
