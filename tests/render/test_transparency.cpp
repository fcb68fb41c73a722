// Opacity and filter: what is seen through a surface, and the shadow that it throws.
#include "check.h"
#include "shot.h"

#include <algorithm>

namespace test_transparency {

namespace {

struct Pane {
    Rgbd filter;
    double opacity;
};
const std::vector<Pane> kPanes = {
    {{0.9, 0.3, 0.5}, 0.25}, {{0.2, 0.8, 0.6}, 0.5}, {{0.7, 0.7, 0.1}, 0}};

std::string material(int number) {
    const Pane& p = kPanes[static_cast<std::size_t>(number)];
    return cat("material pane", number, " {\n diffuse 0.5 0.5 0.5\n opacity ", p.opacity,
               "\n filter ", p.filter.r, " ", p.filter.g, " ", p.filter.b, "\n}\n");
}
std::string pane(int number, double z, const char* kind = "plane") {
    return cat(kind, " p", number, " {\n translate 0 0 ", z, "\n material pane", number, "\n}\n");
}
// (1 - opacity) * filter of the panes whose bit is set.
Vec3d passed(int panes) {
    Vec3d out{1, 1, 1};
    for (std::size_t i = 0; i < kPanes.size(); ++i) {
        if (!(panes >> i & 1)) continue;
        const double t = 1 - kPanes[i].opacity;
        out = {out.x * t * kPanes[i].filter.r, out.y * t * kPanes[i].filter.g,
               out.z * t * kPanes[i].filter.b};
    }
    return out;
}

} // namespace

// The light through any set of panes in any order: the product. The camera is below them.
TEST(colouredShadowsMultiplyInAnyOrder) {
    const shot::TopView view{.pixels = 3, .height = 0.5};
    const std::string scene = view.text() + material(0) + material(1) + material(2) +
                              "plane floor {\n}\nlight l {\n translate 0 0 9\n color 81 81 81\n}\n";
    const Rgb lit = shot::render(scene).at(1, 1);
    for (int set = 0; set < 8; ++set) {
        std::vector<int> order = {0, 1, 2};
        do {
            std::string panes;
            double z = 1;
            for (const int i : order)
                if (set >> i & 1) panes += pane(i, z++, i == 1 ? "disk" : "plane");
            const Vec3d wanted = passed(set) * static_cast<double>(lit.r);
            CHECK_RGB(shot::render(scene + panes).at(1, 1), wanted, 3e-7); // five roundings
        } while (std::next_permutation(order.begin(), order.end()));
    }
    // A solid body has two sides, a mesh works like a plane, an instance like a mesh.
    const Vec3d one = passed(1) * static_cast<double>(lit.r);
    CHECK_RGB(shot::render(scene + pane(0, 2, "cube")).at(1, 1),
              (Vec3d{one.x * passed(1).x, one.y * passed(1).y, one.z * passed(1).z}), 3e-7);
    const std::string quad =
        "mesh q {\n points 4\n -1 -1 0 1 -1 0 1 1 0 -1 1 0\n triangles 2\n 0 1 2 0 2 3\n}\n";
    const std::string instance = "instance a {\n translate 0 0 2\n mesh q\n material pane0\n}\n";
    CHECK_RGB(shot::render(scene + quad + instance).at(1, 1), one, 3e-7);
    CHECK_RGB(shot::render(scene + quad + instance +
                           "instance b {\n translate 0 0 3\n mesh q\n material pane0\n}\n")
                  .at(1, 1),
              (Vec3d{one.x * passed(1).x, one.y * passed(1).y, one.z * passed(1).z}), 3e-7);
    // Something opaque anywhere on the way: no light.
    CHECK_EQUAL(shot::largest(shot::render(scene + pane(2, 2) +
                                           "disk lid {\n translate 0 0 3\n radius 3\n}\n")
                                  .color),
                0.0);
}

// The camera's way through: opacity * shade + (1 - opacity) * filter * what is behind.
TEST(seeingThroughPanes) {
    const shot::TopView view;
    const shot::Shot shot =
        shot::render(view.text() + "world {\n background 2 2 2\n ambient 1 1 1\n}\n" + material(0) +
                     material(1) + pane(0, 1) + pane(1, 0));
    // ambient 1: each pane shades to its diffuse reflectance, 0.5
    const Vec3d top = passed(1), both = passed(3);
    const Vec3d wanted = Vec3d{0.25, 0.25, 0.25} * 0.5 + top * 0.5 * 0.5 + both * 2.0;
    CHECK_RGB(shot.at(1, 1), wanted, 3e-7);
    CHECK_EQUAL(shot.stats.rays.refract, 18u);
}

// Holes cut by a texture: sharp (nearest), seen and in the shadow alike; alpha or luminance.
TEST(opacityTextureCutsHoles) {
    const std::string file = shot::writeTexture("checker.pfm", 4, 4, [](double u, double v) {
        const bool on = (static_cast<int>(u * 4) + static_cast<int>(v * 4)) % 2 == 0;
        return on ? Rgb{1, 1, 1} : Rgb{};
    });
    const std::string scene = "texture holes {\n file " + file +
                              "\n interpolation nearest\n}\n"
                              "material grid {\n diffuse 0 0 0\n opacity_texture holes\n}\nplane "
                              "grid {\n material grid\n}\n";
    const shot::TopView view{.pixels = 20};
    const Image seen = shot::render(view.text() + scene + "world {\n background 1 1 1\n}\n").color;
    const shot::TopView below{.pixels = 20, .height = -0.1};
    const Image shadow = shot::render(below.text() + scene +
                                      "plane floor {\n translate 0 0 -1\n material w\n}\n"
                                      "material w {\n diffuse 1 1 1\n}\nlight l {\n type sun\n}\n")
                             .color;
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool on = (x / 5 + (19 - y) / 5) % 2 == 0;
            CHECK_EQUAL(seen.pixel(x, y).r, on ? 0.0f : 1.0f);
            CHECK_NEAR(shadow.pixel(x, y).r, on ? 0 : 1 / kPi, 1e-7);
        }
}

// Straight rays use up depth as other rays do; at the limit nothing is seen behind.
TEST(transparencyStopsAtTheDepth) {
    std::string panes = material(2);
    for (int i = 0; i < 5; ++i)
        panes += cat("plane q", i, " {\n translate 0 0 ", i, "\n material clear\n}\n");
    panes += "material clear {\n opacity 0\n}\nworld {\n background 1 1 1\n}\n";
    for (const int depth : {4, 5}) {
        shot::TopView view{.pixels = 1, .more = cat("max_depth ", depth)};
        CHECK_EQUAL(shot::render(view.text() + panes).at(0, 0).r, depth == 5 ? 1.0f : 0.0f);
    }
}

} // namespace test_transparency
