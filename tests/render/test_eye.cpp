// The camera's own place: on a surface, and where its pixels are finer than floats.
#include "check.h"
#include "shot.h"

#include "base/text.h"

#include <string>

namespace test_eye {

namespace {

std::string from(const std::string& place, const std::string& more) {
    return "settings {\n resolution 40 30\n samples 1\n}\ncamera c {\n look_at " + place + more +
           "\n}\nlight l {\n translate 2 -3 5\n color 30 30 30\n}\n";
}
Scene sceneOf(const std::string& text) {
    const SceneDesc desc = shot::parse(text);
    RenderSettings settings;
    settings.picture = desc.settings;
    return Scene(desc, {"eye.txt", ""}, settings);
}

} // namespace

// On the surface of a ball, a cube, a triangle and a floor: all of the picture is what is seen from
// a little behind the surface, not some of it the surface itself.
TEST(eye_on_a_surface) {
    const std::string triangle = "mesh q {\n points 3\n -5 0 -5  5 0 -5  0 0 5\n triangles 1\n 0 1 "
                                 "2\n}\ninstance i {\n mesh q\n translate 0 -1 0\n}\n";
    for (const std::string thing :
         {"sphere s {\n}\n", "cube s {\n}\n", "plane s {\n rotate 90 1 0 0\n translate 0 -1 0\n}\n",
          "infinite_plane s {\n translate 0 -1 0\n rotate 90 1 0 0\n}\n", triangle.c_str()}) {
        const std::string world = "world {\n background 0.2 0.4 0.6\n}\n" + thing;
        const Image on = shot::render(from("0 -1 0  0 0 0  0 0 1", "") + world).color;
        const Image behind = shot::render(from("0 -0.9999 0  0 0 0  0 0 1", "") + world).color;
        CHECK_INFO(shot::maxDifference(on, behind) < 1e-3, thing);
        // Nothing is cut off where nothing is that near.
        CHECK_EQUAL(
            sceneOf(from("0 -1.001 0  0 0 0  0 0 1", "") + world).camera().ray({1, 1}, {}, 0).tMin,
            0.0f);
    }
}

// A ball of radius 1 in the middle of a picture of 40 pixels, and a speck beside the camera, which
// is what floats are fine for then: spacing 2^-23 of the distance over the width of a pixel.
TEST(eye_knows_how_fine_floats_are) {
    const std::string ball = "sphere s {\n}\n";
    const auto speck = [](double distance) {
        return cat("sphere t {\n translate 1 ", -distance, " 0\n radius 0.01\n}\n");
    };
    for (const double distance : {10.0, 1e3, 1e6}) {
        const std::string view = from(cat("0 ", -distance, " 0  0 0 0  0 0 1"),
                                      cat("\n lens ", 18 * distance)); // 2 units are 36 mm
        CHECK(sceneOf(view + ball).spacing().value() < 1e-5);
        const double pixel = 2.0 / 40 * (distance - 1) / distance;
        const Scene scene = sceneOf(view + ball + speck(distance));
        CHECK_NEAR(scene.spacing().value(), (distance - 1) * 0x1p-23 / pixel,
                   1e-2 * distance * 0x1p-23 / pixel);
        CHECK_EQUAL(scene.warnings().size(), std::size_t{distance > 100});
    }
    CHECK(!sceneOf(from("0 -9 0  0 -10 0  0 0 1", "") + ball).spacing()); // looks away
}

} // namespace test_eye
