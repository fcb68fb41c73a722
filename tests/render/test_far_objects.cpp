// A far object changes nothing that is near, to the bit, and is right itself.
#include "check.h"
#include "shot.h"

#include "base/text.h"

#include <cmath>
#include <string>

namespace test_far_objects {

namespace {

// A glass ball, a cube, a triangle and their shadows on a plane without end.
const std::string kNear =
    "settings {\n resolution 64 48\n samples 4\n}\nworld {\n background 0.2 0.3 0.4\n}\n"
    "camera c {\n look_at 0 -6 2.5  0 0 0.5  0 0 1\n}\n"
    "light l {\n translate 3 -3 5\n color 40 40 40\n}\n"
    "light k {\n type rectangle\n look_at -3 -3 5  0 0 0  0 0 1\n size 1 1\n color 9 9 9\n}\n"
    "material g {\n diffuse 0 0 0\n mirror 1 1 1\n transmission 1 1 1\n fresnel dielectric\n}\n"
    "infinite_plane floor {\n}\ncube near {\n translate -1 0 0.4\n scale 0.4 0.4 0.4\n}\n"
    "sphere s {\n translate 0.6 -0.3 0.6\n radius 0.6\n material g\n}\n"
    "mesh q {\n points 3\n -1 0 0  1 0 0  0 0 1\n triangles 1\n 0 1 2\n}\n"
    "instance t {\n mesh q\n translate 0 2 0\n}\n";

// Behind the camera, under the floor, so that nothing of it is seen, also not in the ball.
std::string farAway(const std::string& kind, double distance, double size) {
    return cat(kind, " far", distance, " {\n translate 0 ", -distance, " ", -0.5 * distance,
               "\n scale ", size, " ", size, " ", size, "\n", kind == "instance" ? " mesh q\n" : "",
               "}\n");
}

} // namespace

TEST(far_objects_change_nothing_near) {
    const Image alone = shot::render(kNear).color;
    for (const std::string kind : {"cube", "sphere", "cylinder", "instance"})
        for (const double distance : {1e3, 1e5, 1e7, 1e9, 1e15})
            for (const double size : {1.0, 0.01 * distance}) {
                const std::string text = kNear + farAway(kind, distance, size);
                const Image with = shot::render(text).color;
                CHECK_INFO(shot::differingPixels(alone, with) == 0, kind << " " << distance);
            }
    // Ten times as far each; and a hundred, which have a tree.
    std::string chain = kNear, crowd = kNear;
    for (double distance = 100; distance < 1e12; distance *= 10)
        chain += farAway("cube", distance, 1);
    for (int i = 0; i < 100; ++i) crowd += farAway("sphere", 1e6 + 1000 * i, 1);
    CHECK_EQUAL(shot::differingPixels(alone, shot::render(chain).color), 0);
    CHECK_EQUAL(shot::differingPixels(alone, shot::render(crowd).color), 0);
}

// The whole view is one far thing, with or without something near at the camera's back: its colour
// and its distance, in every way of searching.
TEST(far_objects_are_seen) {
    const shot::TopView view{.pixels = 4, .height = 10};
    const std::string near = "sphere n {\n translate 0 0 14\n radius 0.5\n}\n";
    const std::string glow = "material m {\n diffuse 0 0 0\n emission 3 2 1\n}\n"
                             "mesh q {\n points 4\n -1 -1 0  1 -1 0  1 1 0  -1 1 0\n triangles 2\n"
                             " 0 1 2  0 2 3\n}\n";
    for (const std::string kind : {"cube", "sphere", "disk", "instance"})
        for (const double distance : {1e4, 1e7, 1e10})
            for (const int count : {1, 20}) {
                std::string text = view.text() + near + glow;
                for (int i = 0; i < count; ++i)
                    text += cat(kind, " f", i, " {\n material m\n translate 0 0 ",
                                -distance * (1 + 0.1 * i), "\n scale ", distance, " ", distance,
                                " ", kind == "sphere" ? distance : 1, "\n",
                                kind == "instance" ? " mesh q\n" : "", "}\n");
                for (const AccelKind accel : {AccelKind::Bvh, AccelKind::None})
                    for (const Isa& isa : allIsas()) {
                        if (!isa.supported()) continue;
                        const shot::Shot shot = shot::render(text, [&](RenderSettings& s) {
                            s.isa = &isa, s.accel = accel, s.aovs = {Aov::Depth};
                        });
                        const double top = kind == "sphere" ? 0
                                           : kind == "cube" ? -distance + 1
                                                            : -distance;
                        CHECK(shot.at(1, 1) == (Rgb{3, 2, 1}));
                        // Rays are slanted by less than 0.05: the ball's top is 0.2 % lower there.
                        CHECK_NEAR(shot.aov(Aov::Depth).pixel(1, 1).r, 10 - top,
                                   3e-3 * (distance + 10));
                    }
            }
}

// What is far casts shadows on what is near, and lets light through as it should.
TEST(far_objects_cast_shadows) {
    const shot::TopView view{.pixels = 2};
    const std::string floor = "plane p {\n scale 3 3 1\n}\n";
    const std::string sun = "light l {\n type sun\n look_at 0 0 1  0 0 0  0 1 0\n}\n";
    const std::string far = "sphere f {\n translate 0 0 1e8\n scale 1e6 1e6 1e6\n material m\n}\n";
    const auto lit = [&](const std::string& more) {
        return shot::render(view.text() + floor + sun + more).at(0, 0).r;
    };
    const float open = lit("");
    CHECK(open > 0.1f);
    CHECK_EQUAL(lit("material m {\n}\n" + far), 0.0f);
    // Two surfaces of a quarter each.
    CHECK_NEAR(lit("material m {\n opacity 0.75\n filter 1 1 1\n}\n" + far), open / 16, 1e-6);
}

// A ceiling without end, however high and slanted, is between a sun and the floor.
TEST(endless_planes_hide_suns) {
    const shot::TopView view{.pixels = 2};
    const std::string floor = "plane p {\n scale 3 3 1\n}\n";
    for (const double height : {20.0, 1e3, 1e6})
        for (const double slope : {0.0, 45.0, 89.0, 91.0, 135.0}) {
            const std::string text = cat(
                view.text(), floor, "light l {\n type sun\n look_at 0 0.1 1  0 0 0  0 1 0\n}\n",
                "infinite_plane c {\n translate 0 0 ", height, "\n rotate ", slope, " 1 0 0\n}\n");
            // Heights of the place of pixel (1, 0) and of the way to the sun, over the ceiling.
            const double sine = std::sin(radians(slope)), cosine = std::cos(radians(slope));
            const double place = -0.5 * sine - height * cosine, way = -0.1 * sine + cosine;
            for (const bool specialise : {true, false}) {
                const Rgb seen = shot::render(text, [&](RenderSettings& s) {
                                     s.specialise = specialise;
                                 }).at(1, 0);
                CHECK_INFO((seen == Rgb{}) == (place * way < 0),
                           height << " " << slope << " " << specialise);
            }
        }
}

} // namespace test_far_objects
