// Sampler `corners`: rays through the corners of pixels, shared by the four pixels around them.
#include "check.h"
#include "shot.h"

namespace test_corners {

namespace {

// A picture of 8 x 6 pixels of side 1 from straight above, over a plane that shows where it is.
std::string scene(const std::string& more) {
    const std::string file = shot::writeTexture("place.pfm", 64, 64, [](double u, double v) {
        return Rgb{static_cast<float>(u), static_cast<float>(v), static_cast<float>(u * v)};
    });
    return "settings {\n resolution 8 6\n samples 1\n sampler corners\n" + more +
           "}\ncamera c {\n type orthographic\n ortho_scale 8\n look_at 0 0 5  0 0 0  0 1 0\n}\n"
           "texture place {\n file " +
           file +
           "\n extension extend\n}\n"
           "material m {\n diffuse 0 0 0\n emission 1 1 1\n emission_texture place\n}\n"
           "plane p {\n scale 8 8 1\n material m\n}\n";
}

} // namespace

TEST(cornersAreSharedByPixels) {
    const shot::Shot shot = shot::render(scene(""));
    CHECK_EQUAL(shot.color.width(), 8);
    CHECK_EQUAL(shot.color.height(), 6);
    CHECK_EQUAL(shot.stats.rays.camera, 9u * 7u);
    // u and v are linear between the texels, so a mean of corners is the value in the middle; u v
    // is the product of both.
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) {
            const double u = (x + 0.5 - 4) / 16 + 0.5, v = (3 - y - 0.5) / 16 + 0.5;
            CHECK_RGB(shot.at(x, y), (Vec3d{u, v, u * v}), 2e-3); // texels of 1/64, bilinear
        }
}

// A crop has the pixels of the whole picture, and threads change nothing.
TEST(cornersOfCropsAndThreads) {
    const shot::Shot whole = shot::render(scene(""));
    const shot::Shot part = shot::render(scene(" crop 2 1 7 5\n"));
    CHECK_EQUAL(part.color.width(), 5);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) CHECK(part.at(x, y) == whole.at(x + 2, y + 1));
    const shot::Shot threads = shot::render(scene(""), [](RenderSettings& s) { s.threads = 3; });
    CHECK_EQUAL(shot::differingPixels(whole.color, threads.color), 0);
}

// Numbers of objects are not averaged.
TEST(cornersKeepObjectNumbers) {
    const shot::Shot shot =
        shot::render(scene("") + "cube q {\n translate 0 0 1\n}\n", [](RenderSettings& s) {
            s.aovs = {Aov::Id, Aov::Samples};
        });
    const Image& ids = shot.aov(Aov::Id);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) {
            // The upper left corner of the pixel, in the plane of the picture.
            const double px = x - 4.0, py = 3.0 - y;
            const bool onEdge = std::max(std::fabs(px), std::fabs(py)) == 1;
            const bool inside = std::max(std::fabs(px), std::fabs(py)) < 1;
            if (!onEdge) CHECK_EQUAL(ids.pixel(x, y).r, inside ? 2.0f : 1.0f);
        }
    CHECK_EQUAL(shot.aov(Aov::Samples).pixel(3, 3).r, 1.0f);
}

// What a ray may weigh at least: a chain of mirrors ends where its weight falls below the cutoff.
TEST(cutoffEndsChainsOfMirrors) {
    const auto bounces = [](double cutoff) {
        return shot::render(cat("settings {\n resolution 1 1\n samples 1\n jitter false\n"
                                " max_depth 40\n cutoff ",
                                shortest(cutoff),
                                "\n}\ncamera c {\n look_at 0 0 0  1 0 0  0 0 1\n}\n"
                                "material m {\n diffuse 0 0 0\n mirror 0.5 0.5 0.5\n}\n"
                                "plane a {\n translate 1 0 0\n rotate -90 0 1 0\n material m\n}\n"
                                "plane b {\n translate -1 0 0\n rotate 90 0 1 0\n material m\n}\n"))
            .stats.rays.reflect;
    };
    CHECK_EQUAL(bounces(1.0 / 2048), 11u); // 2^-11 is not below it
    CHECK_EQUAL(bounces(0.25), 2u);
    CHECK_EQUAL(bounces(0), 40u);
}

} // namespace test_corners
