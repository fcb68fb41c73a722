// The penumbra of an edge against geometry.
#include "check.h"
#include "shot.h"

namespace test_soft_shadow {

// A strip light of width w at height H over an edge at height h: the penumbra on the floor is
// w h / (H - h) wide, lit before it, dark behind it, and in it the visible part of the light is
// linear in the place (the light is far enough off for its cosines to be even to 1 %).
TEST(penumbraHasTheWidthOfGeometry) {
    const double H = 10, h = 2, w = 0.8, half = w * h / (H - h) / 2;
    const shot::TopView view{.pixels = 64, .side = 0.4, .height = 1, .samples = 64};
    // Its highlight, which nobody sees, keeps the lamp from being asked for its closed form.
    const std::string scene =
        view.text() +
        "material m {\n specular 1e-12 1e-12 1e-12\n}\nplane floor {\n scale 4 4 1\n material "
        "m\n}\n"
        "light l {\n type rectangle\n translate 0 0 10\n size 0.8 0.5\n color 99 99 99\n}\n";
    const Image lit = shot::render(scene).color;
    for (const std::string lid : {"cube lid {\n translate -5 0 2.5\n scale 5 5 0.5\n}\n",
                                  "plane lid {\n translate -5 0 2\n scale 5 5 1\n}\n",
                                  "mesh q {\n points 4\n -9 -9 2 0 -9 2 0 9 2 -9 9 2\n triangles "
                                  "2\n 0 1 2 0 2 3\n}\ninstance lid {\n mesh q\n}\n"}) {
        const Image shadow = shot::render(scene + lid).color;
        // A box has a thick edge: from its upper rim at height 3 the shadow is the same side's.
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const double place = view.place(x, y).x, pixel = view.side / 64;
                const double visible = shadow.pixel(x, y).r / lit.pixel(x, y).r;
                if (place < -half - pixel)
                    CHECK_EQUAL(visible, 0.0);
                else if (place > half + pixel && !lid.starts_with("cube"))
                    CHECK_NEAR(visible, 1, 1e-6);
                // 64 Sobol points against a straight edge: within 2/64, and 1 % for the cosines.
                else if (!lid.starts_with("cube"))
                    CHECK_NEAR(visible, clamp(0.5 + place / (2 * half), 0.0, 1.0), 0.045);
            }
    }
}

// --no-soft-shadows: the lamp sits in its centre, the edge of the shadow is sharp.
TEST(softShadowsSwitchedOffAreSharp) {
    const shot::TopView view{.pixels = 64, .side = 0.4, .height = 1};
    const std::string scene =
        view.text() +
        "plane floor {\n scale 4 4 1\n}\nplane lid {\n translate -5 0 2\n scale 5 5 1\n}\n";
    for (const std::string light :
         {"light l {\n type rectangle\n translate 0 0 10\n size 0.8 0.5\n}\n",
          "light l {\n type disk\n translate 0 0 10\n}\n",
          "light l {\n type sphere\n translate 0 0 10\n radius 0.5\n}\n",
          "light l {\n translate 0 0 10\n radius 0.5\n}\n",
          "light l {\n type sun\n angle 4\n}\n"}) {
        const shot::Shot shot = shot::render(scene + light, [](RenderSettings& s) {
            s.switches.softShadows = false;
            s.specialise = false; // no ray is left out
        });
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                CHECK_EQUAL(isBlack(shot.at(x, y)), view.place(x, y).x < 0);
        CHECK_EQUAL(shot.stats.rays.shadow, 4096u);
    }
}

// N light samples of one camera sample are as good as N camera samples with one each: the same
// mean, and N shadow rays.
TEST(lightSamplesAreCountedAndAveraged) {
    double sigmaOfOne = 0;
    for (const int n : {1, 4, 16}) {
        const shot::TopView view{.pixels = 16,
                                 .side = 1e-3,
                                 .centre = {0.01, 0},
                                 .height = 1,
                                 .more = cat("light_samples ", n, "\n sampler random")};
        const shot::Shot shot = shot::render(
            view.text() +
                "plane floor {\n scale 4 4 1\n}\nplane lid {\n translate -5 0 2\n scale 5 5 1\n}\n"
                "light l {\n type rectangle\n translate 0 0 10\n size 0.8 0.5\n color 99 99 99\n}\n"
                "light hard {\n translate 0 0 99\n}\n",
            [](RenderSettings& s) { s.specialise = false; }); // no ray is left out
        CHECK_EQUAL(shot.stats.rays.shadow, static_cast<std::uint64_t>(256 * n + 256));
        const shot::Estimate e = shot::estimate(shot.color);
        if (n == 1) sigmaOfOne = e.sigma;
        // 1/sqrt(n) of the noise, known to 5 % from 256 pixels each.
        CHECK_NEAR(e.sigma * std::sqrt(n), sigmaOfOne, 0.25 * sigmaOfOne);
        const double full = 0.8 / kPi * (99 * 0.8 * 0.5 / 100 + 1.0 / (99 * 99)),
                     wanted = full * (0.5 + 0.01 / 0.2);
        CHECK_NEAR(e.mean, wanted,
                   3 * e.sigma + 0.004 * full); // the cosines; the hard light is 0.03 %
    }
}

} // namespace test_soft_shadow
