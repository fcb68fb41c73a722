// Which place of the scene a pixel sees, for every kind of camera: the position that --aov gives,
// projected as Blender projects it (Code/camera/camera.h), must be the pixel's centre.
#include "check.h"
#include "shot.h"

namespace test_camera_pixels {

namespace {

struct Case {
    int width, height;
    double aspectX, aspectY;
    std::string fit;
    double shiftX, shiftY;
    bool orthographic;
};

// Side of the picture that the sensor's `size` belongs to, in pixels times aspect.
double fittedSide(const Case& c, double& size) {
    const double x = c.width * c.aspectX, y = c.height * c.aspectY;
    size = c.fit == "vertical" ? 20 : 32;
    if (c.fit == "auto") return std::max(x, y);
    return c.fit == "horizontal" ? x : y;
}

} // namespace

TEST(pixelsSeeTheirPlaces) {
    std::vector<Case> cases;
    for (const bool orthographic : {false, true})
        for (const std::string fit : {"auto", "horizontal", "vertical"})
            for (const auto& [w, h] : {std::pair{12, 8}, std::pair{8, 12}, std::pair{9, 9}})
                for (const auto& [ax, ay] :
                     {std::pair{1.0, 1.0}, std::pair{1.0, 2.0}, std::pair{1.5, 1.0}})
                    cases.push_back({w, h, ax, ay, fit, 0.1, -0.25, orthographic});
    for (const Case& c : cases) {
        const shot::Shot shot = shot::render(
            cat("settings {\n resolution ", c.width, " ", c.height, "\n pixel_aspect ", c.aspectX,
                " ", c.aspectY,
                "\n samples 1\n jitter false\n}\ncamera c {\n look_at 1 -4 3  0.2 0.1 0.5  0 0 1\n "
                "type ",
                c.orthographic ? "orthographic" : "perspective",
                "\n lens 40\n sensor 32 20\n sensor_fit ", c.fit, "\n shift ", c.shiftX, " ",
                c.shiftY, "\n ortho_scale 3\n}\ncube room {\n scale 8 8 8\n}\n"),
            [](RenderSettings& s) {
                s.aovs = {Aov::Position, Aov::Depth};
            });
        const Vec3d eye{1, -4, 3}, forward = normalize(Vec3d{0.2, 0.1, 0.5} - eye);
        const Vec3d right = normalize(cross(forward, Vec3d{0, 0, 1})), up = cross(right, forward);
        double sensor = 0;
        const double side = fittedSide(c, sensor);
        double worst = 0;
        for (int y = 0; y < c.height; ++y)
            for (int x = 0; x < c.width; ++x) {
                const Rgb at = shot.aov(Aov::Position).pixel(x, y);
                const Vec3d d = Vec3d{at.r, at.g, at.b} - eye;
                const double depth = dot(d, forward),
                             scale = c.orthographic ? 3 : depth * sensor / 40;
                // Back from the fitted side to pixels; shift is in units of the fitted side.
                const double px =
                    ((dot(d, right) / scale - c.shiftX) * side / c.aspectX) + c.width / 2.0;
                const double py =
                    c.height / 2.0 - ((dot(d, up) / scale - c.shiftY) * side / c.aspectY);
                worst = std::max({worst, std::fabs(px - x - 0.5), std::fabs(py - y - 0.5)});
                CHECK_NEAR(shot.aov(Aov::Depth).pixel(x, y).r, depth, 1e-5); // of a room of 16 m
            }
        // 1e-6 of 16 m over 3 m in 12 pixels: 1e-4 of a pixel.
        CHECK_INFO(worst < 1e-4, worst << " pixels, fit " << c.fit << " " << c.width << "x"
                                       << c.height << " aspect " << c.aspectX << ":" << c.aspectY
                                       << " ortho " << c.orthographic);
    }
}

// clip_start cuts at a depth, not at a distance: a flat cut that shows what is behind.
TEST(clipStartIsADepth) {
    const auto depth = [](double clip) {
        return shot::render(cat("settings {\n resolution 9 9\n samples 1\n jitter false\n}\ncamera "
                                "c {\n lens 18\n translate 0 0 4\n"
                                " clip_start ",
                                clip,
                                "\n}\nplane near {\n translate 0 0 2\n scale 9 9 1\n}\n"
                                "plane far {\n scale 9 9 1\n}\n"),
                            [](RenderSettings& s) { s.aovs = {Aov::Depth}; })
            .aov(Aov::Depth);
    };
    const Image before = depth(1.999), after = depth(2.001);
    CHECK_NEAR(shot::largest(before), 2, 1e-5);
    CHECK_NEAR(shot::smallest(before), 2, 1e-5);
    CHECK_NEAR(shot::largest(after), 4, 1e-5);
    CHECK_NEAR(shot::smallest(after), 4, 1e-5);
}

// The other AOVs: albedo, normal, id, uv of known things; nothing where nothing is.
TEST(firstHitPictures) {
    const shot::TopView view{.pixels = 4, .side = 4};
    const std::string scene =
        view.text() +
        "material a {\n diffuse 0.25 0.5 0.75\n}\n"
        "plane p {\n translate 1 1 0\n material a\n}\ncube c {\n translate -1 -1 -1\n}\n";
    const shot::Shot shot = shot::render(scene, [](RenderSettings& s) {
        s.aovs = {Aov::Albedo, Aov::Normal, Aov::Id, Aov::Samples};
    });
    CHECK((shot.aov(Aov::Albedo).pixel(2, 1) == Rgb{0.25f, 0.5f, 0.75f}));
    CHECK((shot.aov(Aov::Normal).pixel(2, 1) == Rgb{0, 0, 1}));
    CHECK((shot.aov(Aov::Id).pixel(2, 1) == Rgb{1, 1, 1}));
    CHECK((shot.aov(Aov::Id).pixel(0, 3) == Rgb{2, 2, 2}));
    CHECK((shot.aov(Aov::Id).pixel(0, 0) == Rgb{}));
    CHECK((shot.aov(Aov::Samples).pixel(0, 0) == Rgb{1, 1, 1}));
    const Image uv = shot::render(scene, [](RenderSettings& s) {
                         s.picture.integrator = IntegratorKind::Uv;
                     }).color;
    CHECK_RGB(uv.pixel(2, 1), (Vec3d{0.25, 0.25, 0}), 1e-6);
    CHECK_RGB(uv.pixel(3, 0), (Vec3d{0.75, 0.75, 0}), 1e-6);
    const Image normal = shot::render(scene, [](RenderSettings& s) {
                             s.picture.integrator = IntegratorKind::Normal;
                         }).color;
    CHECK((normal.pixel(2, 1) == Rgb{0.5f, 0.5f, 1}));
}

} // namespace test_camera_pixels
