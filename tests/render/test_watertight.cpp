// Promise P2 in pictures: closed rooms are black inside, convex bodies throw no shadow on
// themselves, shadows begin where bodies touch; at every size and place of the scene.
#include "check.h"
#include "shot.h"
#include "solids.h"

#include "verify/scene_trials.h"

namespace test_watertight {

namespace {

const std::string kLightsOutside =
    "light a {\n translate 3 2 5\n color 100 100 100\n}\nlight b {\n type sun\n rotate 40 1 1 "
    "0\n}\n"
    "light c {\n type sphere\n translate -4 1 2\n radius 1\n color 50 50 50\n}\n"
    "light d {\n type sun\n rotate 180 1 0 0\n}\n";

struct Placing {
    double scale;
    Vec3d offset; // in extents
};
const std::vector<Placing> kPlacings = {{1, {0, 0, 0}},      {1e-6, {0, 0, 0}},
                                        {1e6, {0, 0, 0}},    {1, {1000, -300, 77}},
                                        {1e-6, {0, 0, 1e4}}, {1e6, {1234, 0, -1e5}}};

SceneDesc at(const SceneDesc& desc, const Placing& p) {
    return scenes::moved(scenes::scaled(desc, p.scale), p.offset * p.scale * 2.0);
}

} // namespace

// 512 x 512 rays into a closed room from near one of its corners, with lights outside: every pixel
// exactly black, so no shadow ray and no camera ray (the sky glows) got through an edge.
TEST(closedRoomsAreBlackInside) {
    for (const auto& [mesh, n, placing] :
         {std::tuple{"box", 1, 0}, std::tuple{"box", 7, 3}, std::tuple{"ball", 9, 4}}) {
        const std::string walls =
            solids::text(mesh == std::string("box") ? solids::box(n) : solids::ball(n));
        for (const bool instances : {false, true}) {
            const int side = instances ? 256 : 512;
            const SceneDesc desc = shot::parse(cat(
                "settings {\n resolution ", side, " ", side,
                "\n samples 1\n}\nworld {\n background 1 1 1\n}\n"
                "camera c {\n look_at 0.4 0.3 0.35  -0.3 -0.2 -0.4  0 0 1\n lens 8\n}\n",
                walls, "instance room {\n rotate 33 1 2 3\n mesh ", mesh, "\n}\n",
                instances ? cat("instance other {\n translate 9 0 0\n mesh ", mesh, "\n}\n") : "",
                kLightsOutside));
            const shot::Shot shot =
                shot::render(at(desc, kPlacings[static_cast<std::size_t>(placing)]));
            int leaks = 0;
            for (const Rgb& pixel : shot.color.pixels()) leaks += !isBlack(pixel);
            CHECK_INFO(leaks == 0, leaks << " leaks of " << shot.stats.rays.total() << " rays in "
                                         << mesh << n << instances);
            CHECK_EQUAL(shot.stats.cameraHits, static_cast<std::uint64_t>(side * side));
            CHECK(shot.stats.rays.shadow >
                  static_cast<std::uint64_t>(side * side)); // lights are looked for
        }
    }
}

// Rays that meet edges, diagonals and corners to the last bit: a camera in the middle of a box of
// 16 x 16 squares a side, slopes (x - 32) / 32 and rows and diagonals of equal components.
TEST(raysAtEdgesAndCornersDoNotLeak) {
    for (const std::string turn :
         {"", " rotate 90 1 0 0\n", " rotate -90 0 0 1\n", " scale -1 1 1\n"})
        for (const char* target : {"1 0 0", "0 1 0", "0 0 -1", "1 1 0", "1 1 1"}) {
            const shot::Shot shot =
                shot::render(cat("settings {\n resolution 65 65\n samples 1\n jitter false\n}\n"
                                 "world {\n background 1 1 1\n}\n"
                                 "camera c {\n look_at 0 0 0  ",
                                 target, target == std::string("0 0 -1") ? "  0 1 0" : "  0 0 1",
                                 "\n lens 32\n sensor 65 65\n}\n", solids::text(solids::box(16)),
                                 "instance room {\n mesh box\n", turn, "}\n", kLightsOutside));
            CHECK_EQUAL(shot::largest(shot.color), 0.0);
        }
}

// The same for walls of the shapes with a formula.
TEST(closedShapesAreBlackInside) {
    for (const std::string body : {"sphere", "cube", "cylinder", "cone"})
        for (const Placing& p : kPlacings) {
            const SceneDesc desc = shot::parse(
                "settings {\n resolution 128 128\n samples 1\n}\nworld {\n background 1 1 1\n}\n"
                "camera c {\n look_at 0.1 0.05 -0.4  -0.3 -0.2 0.4  0 1 0\n lens 8\n}\n" +
                body + " room {\n rotate 33 1 2 3\n}\n" + kLightsOutside);
            CHECK_INFO(shot::largest(shot::render(at(desc, p)).color) == 0,
                       body << " at scale " << p.scale);
        }
}

// A convex body has no shadow on itself: the picture with shadows is the one without, to the bit.
// In meshes with flat normals, too: where N.L > 0 on a face, nothing is above that face. The faint
// highlight keeps soft lamps from their closed form, which is for what is known to be in the light.
TEST(convexBodiesDoNotShadowThemselves) {
    const std::string lights =
        "light a {\n translate 3 -2 5\n color 100 100 100\n}\n"
        "light b {\n type sun\n rotate 40 1 1 0\n angle 5\n}\n"
        "light c {\n type rectangle\n look_at -4 -1 2  0 0 0  0 0 1\n size 2 2\n color 9 9 9\n}\n";
    const std::string ball = solids::text(solids::ball(6));
    for (const std::string body :
         {"sphere b {\n", "cube b {\n", "cylinder b {\n", "cone b {\n",
          "cone b {\n top_radius 0.5\n", "disk b {\n", "plane b {\n", "instance b {\n mesh ball\n",
          "instance b {\n mesh ball\n scale 1 0.3 2\n",
          "instance far {\n translate 50 0 0\n mesh ball\n}\ninstance b {\n mesh ball\n"})
        for (const Placing& p : kPlacings) {
            const SceneDesc desc =
                at(shot::parse("settings {\n resolution 64 64\n samples 4\n}\ncamera c {\n look_at "
                               "2 -4 3  0 0 0  0 0 1\n lens 60\n}\nmaterial m {\n specular "
                               "1e-12 1e-12 1e-12\n}\n" +
                               lights + (body.find("mesh") != std::string::npos ? ball : "") +
                               body + " material m\n rotate 33 1 2 3\n}\n"),
                   p);
            const Image with = shot::render(desc).color;
            const Image without =
                shot::render(desc, [](RenderSettings& s) { s.switches.shadows = false; }).color;
            CHECK_INFO(shot::differingPixels(with, without) == 0,
                       shot::differingPixels(with, without)
                           << " pixels of acne: " << body << " scale " << p.scale);
            CHECK(shot::largest(with) > 0.1);
        }
}

// Where a box stands on the floor its shadow begins: a close-up of the edge, a millionth of the
// scene per pixel. Light from the left above, so the floor right of the box is dark up to its wall.
TEST(shadowsBeginAtTheContact) {
    const std::string mesh = solids::text(solids::box(2));
    // Without thickness: only what is crossed right at the floor can throw the shadow.
    const std::string kWall = "plane wall {\n transform 0 0 1 1  0 1 0 0  1 0 0 1\n";
    for (const std::string& box :
         std::vector<std::string>{"cube box {\n", "instance box {\n mesh box\n", kWall})
        for (const std::string floor :
             {"plane floor {\n scale 2 2 1\n}\n", "infinite_plane floor {\n}\n"})
            for (const std::string light : {"light l {\n type sun\n rotate -40 0 1 0\n}\n",
                                            "light l {\n translate -4 0 5\n color 99 99 99\n}\n"}) {
                const shot::TopView view{.pixels = 64, .side = 64e-6 * 4, .centre = {1, 0.1}};
                const SceneDesc desc = shot::parse(
                    view.text() + (box.find("mesh") == std::string::npos ? "" : mesh) + floor +
                    light + box + (box == kWall ? "}\n" : " translate 0 0 1\n}\n"));
                const shot::Shot shot = shot::render(desc, [](RenderSettings& s) {
                    s.aovs = {Aov::Id, Aov::Position};
                });
                int gap = 0, onFloor = 0;
                for (int y = 0; y < 64; ++y)
                    for (int x = 0; x < 64; ++x) {
                        if (view.place(x, y).x < 1) continue; // the lid, the lit side
                        ++onFloor;
                        gap += !isBlack(shot.at(x, y));
                    }
                CHECK_INFO(gap == 0, gap << " lit pixels in the gap: " << box << floor << light);
                CHECK(onFloor > 1500); // half of 4096
            }
}

// A ball on the floor under a lamp overhead: dark to the point of contact, seen from below the
// floor.
TEST(ballTouchesItsShadow) {
    const SceneDesc desc = shot::parse(
        "settings {\n resolution 65 65\n samples 1\n jitter false\n}\nlight l {\n translate 0.5 0 "
        "6\n color 99 99 99\n}\n"
        "camera c {\n type orthographic\n ortho_scale 1.5\n look_at 0 -5 0.02  0 0 0  0 0 1\n}\n"
        "plane floor {\n scale 3 3 1\n}\nsphere ball {\n translate 0 0 1\n}\n");
    const shot::Shot shot = shot::render(desc, [](RenderSettings& s) {
        s.aovs = {Aov::Position, Aov::Id};
    });
    int dark = 0;
    for (int y = 0; y < 65; ++y)
        for (int x = 0; x < 65; ++x) {
            const Rgb p = shot.aov(Aov::Position).pixel(x, y);
            if (shot.aov(Aov::Id).pixel(x, y).r != 1 || p.r * p.r + p.g * p.g > 1) continue;
            ++dark;
            CHECK(isBlack(shot.at(x, y)));
        }
    CHECK(dark > 20);
}

} // namespace test_watertight
