// What a scene says it needs, what it counts, and scenes that lack something.
#include "check.h"
#include "scenes.h"
#include "shot.h"

#include <algorithm>
#include <atomic>
#include <set>

namespace test_features {

namespace {

std::set<std::string> needed(const shot::Shot& shot) {
    return {shot.stats.featuresNeeded.begin(), shot.stats.featuresNeeded.end()};
}
std::string reason(const shot::Shot& shot, const std::string& feature) {
    for (const std::string& line : shot.stats.featuresSkipped)
        if (line.starts_with(feature + ": ")) return line.substr(feature.size() + 2);
    return "";
}

const shot::TopView kView;
const std::string kBall = "sphere s {\n material m\n}\n";
const std::string kPlain = "material m {\n diffuse 1 1 1\n}\n";

} // namespace

// Each feature in a scene of its own: needed there, skipped with a reason in the plain scene.
TEST(featuresAreFound) {
    shot::writeTexture("white.pfm", 1, 1, [](double, double) { return Rgb{1, 1, 1}; });
    const std::string texture = "texture t {\n file white.pfm\n}\n";
    const auto material = [](const std::string& lines) {
        return "material m {\n" + lines + "}\n" + kBall;
    };
    const std::string point = kPlain + kBall + "light l {\n translate 0 0 5\n",
                      quad = "mesh q {\n points 3\n 0 0 0 1 0 0 0 1 0\n triangles 1\n 0 1 2\n}\n";
    struct Case {
        std::string text;
        std::set<std::string> needs;
    };
    const std::vector<Case> cases = {
        {kPlain + kBall, {}},
        {point + "}\n", {"shadows"}},
        {point + " radius 1\n}\n", {"shadows", "soft-shadows"}},
        {point + " type sun\n}\n", {"shadows"}},
        {point + " type sun\n angle 1\n}\n", {"shadows", "soft-shadows"}},
        {point + " type spot\n}\n", {"shadows"}},
        {point + " type rectangle\n}\n", {"shadows", "soft-shadows"}},
        {point + " type disk\n}\n", {"shadows", "soft-shadows"}},
        {point + " type sphere\n radius 1\n}\n", {"shadows", "soft-shadows"}},
        {material(" mirror 1 1 1\n"), {"reflection"}},
        {material(" mirror 1 1 1\n roughness 0.1\n"), {"reflection", "glossy"}},
        {material(" roughness 0.1\n"), {}},
        {material(" transmission 1 1 1\n"), {"refraction"}},
        {material(" transmission 1 1 1\n mirror 1 1 1\n fresnel dielectric\n"),
         {"reflection", "refraction", "fresnel"}},
        {material(" opacity 0.5\n"), {"transparency"}},
        {texture + material(" opacity_texture t\n"), {"transparency", "textures"}},
        {texture + material(" diffuse_texture t\n"), {"textures"}},
        {texture + material(" lobe diffuse weight 1 1 1 times t\n"), {"textures"}},
        {texture + material(" bump_map t\n"), {"textures", "bump"}},
        {texture + material(" normal_map t\n"), {"textures", "bump"}},
        {texture + kPlain + kBall, {}},
        {texture + kPlain + kBall + "world {\n environment t\n background 1 1 1\n}\n",
         {"textures", "environment"}},
        {kPlain + "sphere s {\n key\n translate 1 0 0\n}\n", {"motion-blur"}},
        {kPlain + "sphere s {\n translate 1 0 0\n key\n translate 1 0 0\n}\n", {}},
        {kPlain + quad + "instance i {\n mesh q\n}\n", {}},
        {kPlain + quad + "instance i {\n mesh q\n}\ninstance j {\n mesh q\n}\n", {"instances"}}};
    for (const Case& c : cases) {
        const shot::Shot shot = shot::render(kView.text() + c.text);
        CHECK_INFO(needed(shot) == c.needs, "needed: " << join(shot.stats.featuresNeeded) << " in\n"
                                                       << c.text);
        CHECK_EQUAL(shot.stats.featuresNeeded.size() + shot.stats.featuresSkipped.size(), 14u);
    }
    // Camera and sampling.
    const shot::Shot dof = shot::render(
        "settings {\n resolution 3 3\n samples 2\n}\ncamera c {\n aperture_radius 1\n}\n");
    CHECK((needed(dof) == std::set<std::string>{"dof", "aa"}));
    const shot::Shot plain = shot::render(kView.text() + kPlain + kBall);
    CHECK_EQUAL(reason(plain, "dof"), "aperture_radius is 0");
    CHECK_EQUAL(reason(plain, "shadows"), "no light casts shadows");
    const shot::Shot off = shot::render(kView.text() + point + "}\n",
                                        [](RenderSettings& s) { s.switches.shadows = false; });
    CHECK_EQUAL(reason(off, "shadows"), "switched off");
}

// Every feature occurs in the golden scenes.
TEST(goldenScenesUseEverything) {
    std::set<std::string> all;
    for (const auto& [name, text] : scenes::all()) all.merge(needed(shot::render(text)));
    CHECK_EQUAL(all.size(), 14u);
}

TEST(emptySceneIsItsBackground) {
    for (const std::string camera :
         {"camera c {\n}\n", "camera c {\n type orthographic\n translate 5 4 3\n}\n"}) {
        const shot::Shot shot = shot::render(
            "settings {\n resolution 5 4\n samples 3\n}\nworld {\n background 0.25 0.5 4\n}\n" +
            camera);
        for (const Rgb& pixel : shot.color.pixels()) CHECK((pixel == Rgb{0.25f, 0.5f, 4}));
        CHECK_EQUAL(shot.stats.rays.camera, 60u);
        CHECK_EQUAL(shot.stats.rays.skipped.emptyTileRays, 60u);
        CHECK_EQUAL(shot.stats.rays.total(), 0u);
        CHECK_EQUAL(shot.stats.cameraHits, 0u);
    }
    const Image other =
        shot::render("settings {\n resolution 1 1\n}\ncamera c {\n}\n", [](RenderSettings& s) {
            s.background = Rgbd{1, 2, 3};
        }).color;
    CHECK((other.pixel(0, 0) == Rgb{1, 2, 3}));
}

TEST(withoutLightsThereIsOnlyAmbient) {
    const shot::Shot shot =
        shot::render(kView.text() + kPlain + kBall + "world {\n ambient 0.5 0.25 0\n}\n");
    CHECK((shot.at(1, 1) == Rgb{0.5f, 0.25f, 0}));
    CHECK_EQUAL(shot.stats.rays.shadow, 0u);
}

// Depth 0: camera rays and shadow rays only.
TEST(depthZeroIsRayCasting) {
    const std::string scene = "material m {\n diffuse 0.5 0.5 0.5\n mirror 1 1 1\n transmission 1 "
                              "1 1\n opacity 0.5\n}\n" +
                              kBall +
                              "light l {\n translate 0 0 5\n}\nworld {\n background 1 1 1\n}\n";
    shot::TopView view{.pixels = 4, .side = 1, .more = "max_depth 0"};
    const shot::Shot shot = shot::render(
        view.text() + scene, [](RenderSettings& s) { s.specialise = false; }); // no ray is left out
    CHECK_EQUAL(shot.stats.rays.camera, 16u);
    CHECK_EQUAL(shot.stats.rays.shadow, 16u);
    CHECK_EQUAL(shot.stats.rays.reflect + shot.stats.rays.refract + shot.stats.rays.indirect, 0u);
    CHECK(shot::largest(shot.color) < 0.05); // nothing of the white sky
}

// Exact ray counts: a mirror over a floor, two lights, one of them soft with 3 samples.
TEST(rayCountsAreExact) {
    shot::TopView view{.pixels = 8, .side = 1, .height = 1, .more = "light_samples 3"};
    const shot::Shot shot = shot::render(
        view.text() +
        "material mirror {\n diffuse 0 0 0\n mirror 0.5 0.5 0.5\n}\nplane m {\n material "
        "mirror\n}\n"
        "material shiny {\n specular 0.1 0.1 0.1\n}\n" // else soft lamps need no rays there
        "plane ceiling {\n translate 0 0 2\n rotate 180 1 0 0\n scale 9 9 1\n material shiny\n}\n"
        "light a {\n translate 0 0 1.5\n}\nlight b {\n type sphere\n translate 3 0 1\n radius "
        "0.1\n}\n"
        "light dark {\n translate 0 0 1\n color 0 0 0\n}\nlight above {\n translate 0 0 5\n}\n");
    CHECK_EQUAL(shot.stats.rays.camera, 64u);
    CHECK_EQUAL(shot.stats.cameraHits, 64u);
    CHECK_EQUAL(shot.stats.rays.reflect, 64u);          // each meets the ceiling
    CHECK_EQUAL(shot.stats.rays.shadow, 64u * (1 + 3)); // there; none to lamps that give no light
    CHECK_EQUAL(shot.stats.rays.refract, 0u);
    CHECK_EQUAL(shot.stats.samplesMean, 1.0);
    CHECK_EQUAL(shot.stats.accel.primitives, 2u);
}

// Triangles without area are counted and left out.
TEST(degenerateTrianglesAreCounted) {
    const shot::Shot shot =
        shot::render(kView.text() + "mesh q {\n points 4\n -1 -1 0 1 -1 0 1 1 0 0 0 0\n triangles "
                                    "3\n 0 1 2  0 3 2  1 1 2\n}\ninstance i {\n mesh q\n}\n");
    CHECK_EQUAL(shot.stats.degeneratePrimitives, 2u);
    CHECK_EQUAL(shot.stats.nanSamples, 0u);
}

// A highlight of 1e15 in a light of 1e30 overflows in its middle: such samples are counted, and the
// picture stays finite everywhere.
TEST(overflowIsCountedNotShown) {
    const shot::TopView view{.pixels = 16, .side = 2, .samples = 4};
    const shot::Shot shot = shot::render(
        view.text() + "material m {\n diffuse 0 0 0\n specular 1e15 1e15 1e15\n exponent 1000\n}\n"
                      "plane p {\n scale 3 3 1\n material m\n}\n"
                      "light l {\n translate 0 0 1\n color 1e15 1e15 1e15\n"
                      " attenuation 0 0 1e-15\n}\n");
    // cos^1000 of half the angle to the lamp is above 3.4e38 / 1e45 up to 0.3585 from its foot:
    // pi 0.3585^2 / 4 of the 1024 samples.
    CHECK_NEAR(static_cast<double>(shot.stats.nanSamples), 103, 12);
    for (const Rgb& pixel : shot.color.pixels()) CHECK(std::isfinite(pixel.r + pixel.g + pixel.b));
    CHECK((shot.at(0, 0) == Rgb{})); // far from it
}

TEST(stoppedRendersAreNotFinished) {
    const SceneDesc desc = shot::parse(kView.text() + kPlain + kBall);
    RenderSettings settings;
    settings.picture = desc.settings;
    const Scene scene(desc, {"test", ""}, settings);
    Stats stats;
    const std::atomic<bool> stop{true};
    CHECK(!render(scene, settings, {{}, &stop}, stats).finished);
    double last = 0;
    const auto progress = [&](double part) {
        CHECK(part > last);
        last = part;
    };
    const Picture done = render(scene, settings, {progress, nullptr}, stats);
    CHECK(done.finished);
    CHECK_EQUAL(last, 1.0);
    settings.camera = "none";
    CHECK_THROWS(Scene(desc, {"test", ""}, settings), "no camera 'none'");
}

} // namespace test_features
