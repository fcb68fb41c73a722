// Lamps with a size in closed form: the same bits whoever asks, no noise where nothing can hide the
// lamp, and no bias where something may.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "shot.h"
#include "verify/meshes.h"

namespace test_whole_lamps {

using meshes::Random;

namespace {

// A few shapes and one or two lamps with a size, near and far, some of them meshes.
std::string fewShapes(Random& random, bool withMeshes) {
    const auto place = [&](double reach) {
        const Vec3d p = random.inBox(reach);
        return cat(" translate ", p.x, " ", p.y, " ", p.z + 0.5, "\n");
    };
    std::string text =
        shot::TopView{.pixels = 16, .side = 4, .samples = 2, .more = "light_samples 4"}.text() +
        "material m {\n diffuse 0.6 0.5 0.2\n}\n"
        "material n {\n diffuse 0.1 0.5 0.2\n mirror 0.5 0.5 0.5\n transmission 0.5 0.5 0.5\n}\n"
        "material o {\n diffuse 0.3 0.2 0.2\n specular 0.3 0.2 0.2\n}\n"
        "mesh q {\n points 4\n -0.5 -0.5 0 0.5 -0.5 0 0.5 0.5 0 -0.5 0.5 0\n triangles 2\n"
        " 0 1 2 0 2 3\n}\n";
    text += random.chance(0.5) ? "infinite_plane floor {\n material m\n}\n"
                               : "plane floor {\n scale 3 3 1\n material m\n}\n";
    const char* const kinds[] = {"sphere", "cube", "cylinder", "cone", "disk"};
    for (std::uint32_t i = 1 + random.below(4); i > 0; --i) {
        const bool isMesh = withMeshes && random.chance(0.5);
        const std::string kind = isMesh ? "instance" : kinds[random.below(5)];
        text += cat(kind, " s", i, " {\n", isMesh ? " mesh q\n" : "", " material ",
                    std::string("mmno")[random.below(4)], "\n", place(1.5), " rotate ",
                    random.chance(0.5) ? 0 : random.uniform(0, 90), " 1 2 3\n scale ",
                    random.uniform(0.1, 0.6), " 0.4 0.5\n}\n");
    }
    for (std::uint32_t i = 1 + random.below(2); i > 0; --i) {
        const char* const fades[] = {"1 0 0", "0 0 1", "1 0.1 0.2"};
        const bool isBall = random.chance(0.2), isFlat = !isBall && random.chance(0.2);
        text += cat("light l", i, " {\n", place(3), " color 3 4 5\n",
                    isFlat ? " type rectangle\n size 0.5 1\n rotate 150 1 0.2 0\n"
                           : cat(" radius ", random.logUniform(0.05, 1), "\n"),
                    isBall   ? " type sphere\n"
                    : isFlat ? ""
                             : cat(" attenuation ", fades[random.below(3)], "\n"),
                    random.chance(0.2) ? " shadows false\n" : "", "}\n");
    }
    return text;
}

} // namespace

TEST(wholeLampsHaveTheSameBitsForAll) {
    const std::uint64_t seed = 915;
    Random random(seed);
    int renders = 0;
    for (int i = 0; i < check::scaled(120); ++i) {
        const std::string text = fewShapes(random, i % 2 == 0);
        const Image alone = shot::render(text).color;
        const auto judge = [&](const std::string& how, const shot::Tweak& tweak) {
            ++renders;
            CHECK_INFO(shot::differingPixels(shot::render(text, tweak).color, alone) == 0,
                       how << ", case " << i << " of seed " << seed << ":\n"
                           << text);
        };
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            const std::string name(kernel.name);
            judge(name, [&](RenderSettings& s) { s.isa = &kernel; });
            judge(name + ", general", [&](RenderSettings& s) {
                s.isa = &kernel, s.specialise = false, s.chunkSamples = 100;
            });
            judge(name + ", instances", [&](RenderSettings& s) {
                s.isa = &kernel, s.copiedTriangles = 0, s.accel = AccelKind::None;
            });
        }
    }
    CHECK(renders >= 3 * check::scaled(120));
}

// The same of lamps that cast no shadows, alone and beside some that do, with a size or without.
TEST(openLampsHaveTheSameBitsForAll) {
    const std::uint64_t seed = 916;
    Random random(seed);
    int lit = 0;
    for (int i = 0; i < check::scaled(60); ++i) {
        const std::string text = fewShapes(random, i % 2 == 0);
        const auto renderBy = [&](const Isa& kernel, bool specialise) {
            return shot::render(text, [&](RenderSettings& s) {
                s.isa = &kernel, s.specialise = specialise;
                s.switches.softShadows = i % 4 < 2, s.switches.shadows = i % 3 == 0;
            });
        };
        const Image alone = renderBy(oneLane(), false).color;
        lit += shot::largest(alone) > 0;
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            for (const bool specialise : {true, false})
                CHECK_INFO(shot::differingPixels(renderBy(kernel, specialise).color, alone) == 0,
                           kernel.name << ", case " << i << " of seed " << seed << ":\n"
                                       << text);
        }
    }
    CHECK(lit > 0);
}

// One sample of a lamp says all where nothing is near: every pixel has the closed form, to the
// rounding of floats. 1 / (d^2 + r^2) of a lamp that fades, ln(1 + x) / (x d^2), x = r^2 / d^2,
// times d^2 of one that doesn't.
TEST(wholeLampsAreFreeOfNoise) {
    const shot::TopView view{.pixels = 8, .side = 1, .more = "sampler random"};
    const std::string scene = view.text() + "material m {\n diffuse 0.8 0.8 0.8\n}\n"
                                            "plane floor {\n scale 2 2 1\n material m\n}\n"
                                            "sphere s {\n translate 3 0 0.5\n radius 0.5\n}\n";
    const Vec3d lamp{-0.3, 0.2, 1.5};
    const double r = 0.75;
    for (const bool fades : {true, false}) {
        const std::string light =
            cat("light l {\n translate -0.3 0.2 1.5\n radius 0.75\n color 3 3 3\n attenuation ",
                fades ? "1 0 0" : "0 0 1", "\n}\n");
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            const shot::Shot shot =
                shot::render(scene + light, [&](RenderSettings& s) { s.isa = &kernel; });
            CHECK_EQUAL(shot.stats.rays.shadow, 0u);
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x) {
                    const Vec2d p = view.place(x, y);
                    const Vec3d d = lamp - Vec3d{p.x, p.y, 0};
                    const double d2 = dot(d, d), ratio = r * r / d2;
                    const double mean = fades ? 1 / (d2 + r * r) : std::log1p(ratio) / ratio;
                    const double expected = 0.8 / kPi * 3 * mean * d.z / std::sqrt(d2);
                    CHECK_NEAR(shot.at(x, y).r, expected, 1e-6 * expected);
                }
        }
    }
}

// A lamp near the floor, of which a plane hides the half that is higher: what arrives is the other
// half's, however few samples tell. The disk faces the point, which is 1 away from its middle, by
// 0.6 0 0.8; the plane begins halfway there and is perpendicular to the way. With s the distance of
// a place from the middle of the disk, and f its angle from the side that is higher, the integrand
// is (0.8 + 0.6 s cos f) / (1 + s^2)^2.
TEST(wholeLampsDoNotBiasPenumbrae) {
    const double r = 0.6, bottom = (std::atan(r) - r / (1 + r * r)) / 2;
    const double expected = 0.8 / kPi * 3 * (0.8 / (1 + r * r) / 2 - 1.2 / (kPi * r * r) * bottom);
    for (const int samples : {1, 2, 4}) {
        const shot::TopView view{.pixels = 48,
                                 .side = 1e-4,
                                 .height = 0.2,
                                 .samples = 4,
                                 .more = cat("light_samples ", samples, "\n sampler random")};
        const std::string scene =
            view.text() +
            "material m {\n diffuse 0.8 0.8 0.8\n}\nplane floor {\n scale 4 4 1\n "
            "material m\n}\nplane lid {\n transform -0.8 0 0.6 -0.5  0 3 0 0  0.6 0 "
            "0.8 1\n}\nlight l {\n translate 0.6 0 0.8\n radius 0.6\n color 3 3 3\n}\n";
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            const shot::Shot shot =
                shot::render(scene, [&](RenderSettings& s) { s.isa = &kernel; });
            const shot::Estimate e = shot::estimate(shot.color);
            CHECK_INFO(std::fabs(e.mean - expected) < 3 * e.sigma,
                       kernel.name << ", " << samples << " samples: " << e.mean << " +- " << e.sigma
                                   << ", expected " << expected);
            CHECK_INFO(e.sigma < 0.02 * expected, e.sigma / expected);
        }
    }
}

} // namespace test_whole_lamps
