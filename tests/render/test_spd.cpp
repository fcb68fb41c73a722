// External truth: the Standard Procedural Databases at their standard sizes, read as NFF text and
// traced by the corner rays of their rules. Published counts: Readme.txt of SPD; it says of tetra
// that they "should be the same for all users", of the others that they should agree within 10 %.
#include "check.h"
#include "desc/validate.h"
#include "read/nff/read_nff.h"
#include "render/render.h"
#include "scene/scene.h"
#include "spd.h"

#include <algorithm>

namespace test_spd {

namespace {

Stats traced(const char* name, const std::string& text) {
    const SourceFile source{name, text};
    Diagnostics diagnostics;
    SceneDesc desc = readNff(source, {{}, diagnostics});
    validate(desc, source, diagnostics);
    RenderSettings settings;
    settings.picture = desc.settings;
    settings.picture.sampler = SettingsDesc::Sampler::Corners;
    settings.picture.samplesPerPixel = 1;
    settings.threads = 2;
    const Scene scene(desc, source, settings);
    Stats stats;
    render(scene, settings, {}, stats);
    std::printf("%s: %llu eye rays, %llu of them hit, %llu reflected, %llu shadow rays\n", name,
                static_cast<unsigned long long>(stats.rays.camera),
                static_cast<unsigned long long>(stats.cameraHits),
                static_cast<unsigned long long>(stats.rays.reflect),
                static_cast<unsigned long long>(stats.rays.shadow));
    CHECK_EQUAL(stats.rays.camera, 513u * 513u);
    return stats;
}

void checkCount(std::uint64_t count, double published, double part) {
    CHECK_NEAR(static_cast<double>(count), published, part * published);
}

} // namespace

// 20 of 263,169: rays along edges, which other programs round otherwise.
TEST(spdTetraHasItsPublishedRays) {
    const std::string text = spd::tetra(6);
    CHECK_EQUAL(std::count(text.begin(), text.end(), 'p'), 4096 + 1); // and "up"
    const Stats stats = traced("tetra", text);
    CHECK_NEAR(static_cast<double>(stats.rays.camera - stats.cameraHits), 213381, 20);
    CHECK_NEAR(static_cast<double>(stats.rays.shadow), 46111, 20);
    CHECK_EQUAL(stats.rays.reflect, 0u);
}

TEST(spdBallsHaveTheirPublishedRays) {
    const Stats stats = traced("balls", spd::balls(4));
    checkCount(stats.cameraHits, 263169, 0.001);
    checkCount(stats.rays.reflect, 175095, 0.03);
    checkCount(stats.rays.shadow, 954368, 0.03);
}

// A pane of glass without Ks before the camera, and behind it the open side of a box of which only
// backs are seen. Each eye ray is reflected once; what passes meets the box, from within.
TEST(spdGlassReflectsAndBacksAreSeen) {
    const std::string text = "v from 0 0 9 at 0 0 0 up 0 1 0 angle 30 hither 1 resolution 512 512\n"
                             "b 0 0 1 l 0 0 20 f 1 1 1 0.2 0 1 0.8 1\n"
                             "p 4 -9 -9 5 9 -9 5 9 9 5 -9 9 5\n"
                             "f 1 0 0 1 0 1 0 0\n"
                             "p 4 -9 9 0 9 9 0 9 -9 0 -9 -9 0\n";
    const Stats stats = traced("glass", text);
    CHECK_EQUAL(stats.cameraHits, 513u * 513u);
    CHECK_EQUAL(stats.rays.reflect, 513u * 513u);
    CHECK_EQUAL(stats.rays.refract, 513u * 513u);
    // Towards the light from the pane, and from the box, whose normal is turned to the eye.
    CHECK_EQUAL(stats.rays.shadow, 2 * 513u * 513u);
}

TEST(spdRingsHaveTheirPublishedRays) {
    const Stats stats = traced("rings", spd::rings(7));
    checkCount(stats.cameraHits, 263169, 0.001);
    checkCount(stats.rays.reflect, 315236, 0.03);
    checkCount(stats.rays.shadow, 1085002, 0.03);
}

} // namespace test_spd
