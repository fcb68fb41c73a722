#include "check.h"
#include "cli/advice.h"

#include <cmath>

namespace test_advice {

namespace {

// 4 x 3 pixels, the first `count` of them of this colour, the others black.
Picture picture(Rgb color, int count) {
    Picture out;
    out.color = Image(4, 3);
    for (int i = 0; i < count; ++i) out.color.setPixel(i % 4, i / 4, color);
    return out;
}
RenderSettings exposed(double ev) {
    RenderSettings settings;
    settings.picture.exposureEv = ev;
    return settings;
}
std::string adviceOf(const PictureLevels& levels, double ev = 0, bool keepsBright = false) {
    return adviceOn(levels, ev, keepsBright).value_or("");
}

} // namespace

TEST(advice_levels_of_a_picture) {
    const PictureLevels grey = levelsOf(picture({0.1f, 0.5f, 0.2f}, 5), exposed(0));
    CHECK_EQUAL(grey.pixels, 12u);
    CHECK_EQUAL(grey.clipped, 0u);
    CHECK(std::fabs(grey.brightest - 0.5f) < 0.004f); // a code is 0.008 wide there
    const PictureLevels bright = levelsOf(picture({0, 0.26f, 0}, 7), exposed(2));
    CHECK_EQUAL(bright.clipped, 7u);
    CHECK_EQUAL(bright.brightest, 1.0f);
    RenderSettings linear = exposed(0);
    linear.picture.transfer = SettingsDesc::Transfer::Linear;
    CHECK(std::fabs(levelsOf(picture({0.25f, 0, 0}, 1), linear).brightest - 0.25f) < 0.002f);
    CHECK_EQUAL(levelsOf(picture({}, 12), exposed(5)).brightest, 0.0f);
}

TEST(advice_levels_are_those_of_codes) {
    for (const float value : {0.0f, 0.01f, 0.3f, 1.0f, 7.0f}) {
        const Picture floats = picture({0.1f, value, 0}, 8);
        Picture codes;
        codes.codes = CodedImage(4, 3, {});
        codes.codes.put(0, 0, floats.color.pixels());
        for (const std::optional<Rgb> white :
             {std::optional<Rgb>(), std::optional(Rgb{0.1f, 1, 0})}) {
            const PictureLevels a = levelsOf(floats, exposed(0), white);
            const PictureLevels b = levelsOf(codes, exposed(0), white);
            CHECK_EQUAL(a.brightest, b.brightest);
            CHECK_EQUAL(a.clipped, b.clipped);
            CHECK_EQUAL(a.pixels, b.pixels);
            CHECK_EQUAL(a.clipped, value >= 1 && !white ? 8u : 0u);
        }
    }
}

TEST(advice_on_dark_pictures) {
    CHECK_EQUAL(adviceOf({.brightest = 0, .pixels = 9}),
                "raytracer: warning: the picture is black; no light reaches what the camera sees "
                "(--integrator normal shows what it is)");
    CHECK_EQUAL(
        adviceOf({.brightest = 0.0101f, .pixels = 9}),
        "raytracer: warning: the brightest value of the picture is 0.0101; more light shows "
        "more, or --exposure 6");
    // An exposure adds to the one that is there, and with it the brightest value is 1/2 to 1.
    CHECK(adviceOf({.brightest = 0.0101f, .pixels = 9}, -3).ends_with("--exposure 3"));
    CHECK(adviceOf({.brightest = 0.0199f, .pixels = 9}).ends_with("--exposure 5"));
    CHECK_EQUAL(adviceOf({.brightest = 0.02f, .pixels = 9}), "");
    CHECK_EQUAL(adviceOf({.brightest = 1, .pixels = 9}), "");
    CHECK(adviceOf({.brightest = 0.001f, .pixels = 9}, 0, true).ends_with("--exposure 9"));
}

TEST(advice_on_clipped_pictures) {
    CHECK_EQUAL(adviceOf({.brightest = 1, .pixels = 10, .clipped = 5}), "");
    CHECK_EQUAL(adviceOf({.brightest = 1, .pixels = 10, .clipped = 6}),
                "raytracer: warning: 60 % of the pixels are as bright as can be; less light shows "
                "more, or --exposure -2");
    CHECK(adviceOf({.brightest = 1, .pixels = 10, .clipped = 6}, 1.5).ends_with("--exposure -0.5"));
    // Files that tell what is above 1 have lost nothing.
    CHECK_EQUAL(adviceOf({.brightest = 1, .pixels = 10, .clipped = 10}, 0, true), "");
}

} // namespace test_advice
