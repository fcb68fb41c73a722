// What a render counts as skipped, in scenes where it can be told beforehand; that pictures stay
// the same is test_specialise.cpp's.
#include "check.h"
#include "scene/texture_files.h"
#include "shot.h"

#include <filesystem>

namespace test_skipped {

namespace {

const std::string kPlain = "material m {\n diffuse 0.8 0.8 0.8\n}\n";
const std::string kFloor = "plane p {\n scale 3 3 1\n material m\n}\n";
constexpr std::uint64_t kPoints = 64;

// A floor that fills the picture, one sample for each of 64 pixels.
Stats seen(const std::string& more, const std::string& text) {
    const shot::TopView view{.pixels = 8, .side = 1, .more = more};
    return shot::render(view.text() + text).stats;
}
std::string lamp(const std::string& lines) { return "light l {\n color 9 9 9\n " + lines + "\n}\n"; }

} // namespace

// A ball in a corner lies in one tile: of 32 x 32 pixels with one sample, of 16 x 16 with more.
TEST(skipped_tiles_are_those_without_the_ball) {
    const std::string ball = kPlain + "sphere s {\n translate -1.7 1.7 0\n radius 0.1\n material m\n}\n";
    const auto counts = [&](int samples, bool specialise) {
        const shot::TopView view{.pixels = 64, .side = 4, .samples = samples};
        return shot::render(view.text() + ball,
                            [&](RenderSettings& s) { s.specialise = specialise; })
            .stats.rays;
    };
    const RayCounts one = counts(1, true), four = counts(4, true), all = counts(4, false);
    CHECK_EQUAL(one.camera, 64u * 64u);
    CHECK_EQUAL(one.skipped.emptyTileRays, 64u * 64u - 32u * 32u);
    CHECK_EQUAL(one.skipped.rayNumbers, 5u * 32u * 32u); // places are in the middle
    CHECK_EQUAL(four.camera, 4u * 64u * 64u);
    CHECK_EQUAL(four.skipped.emptyTileRays, 4u * (64u * 64u - 16u * 16u));
    CHECK_EQUAL(four.skipped.rayNumbers, 3u * 4u * 16u * 16u); // no lens, no time
    CHECK_EQUAL(four.total(), 4u * 16u * 16u);
    CHECK_EQUAL(all.total(), 4u * 64u * 64u);
    CHECK_EQUAL(all.skipped.emptyTileRays + all.skipped.rayNumbers, 0u);
}

TEST(skipped_samples_of_lamps_that_bring_no_light) {
    const std::string floor = kPlain + kFloor, under = lamp("translate 0 0 -4");
    for (const std::string integrator : {"integrator whitted", "integrator path"}) {
        const RayCounts dark = seen(integrator, floor + under).rays;
        CHECK_EQUAL(dark.skipped.unlitSamples, kPoints);
        CHECK_EQUAL(dark.shadow, 0u);
        const RayCounts lit = seen(integrator, floor + lamp("translate 0 0 4")).rays;
        CHECK_EQUAL(lit.skipped.unlitSamples, 0u);
        CHECK_EQUAL(lit.shadow, kPoints);
        CHECK_EQUAL(lit.tracedShadow, kPoints);
        const RayCounts open = seen(integrator, floor + lamp("translate 0 0 4\n shadows false")).rays;
        CHECK_EQUAL(open.shadow, kPoints);
        CHECK_EQUAL(open.tracedShadow, 0u);
    }
    const RayCounts soft =
        seen("light_samples 3", floor + lamp("type sphere\n radius 0.1\n translate 0 0 -4")).rays;
    CHECK_EQUAL(soft.skipped.unlitSamples, 3 * kPoints);
    CHECK_EQUAL(soft.shadow, 0u);
}

// What only shines needs neither shadow rays nor bounces.
TEST(skipped_points_reflect_nothing) {
    const std::string glow = "material m {\n diffuse 0 0 0\n emission 1 1 1\n}\n";
    for (const std::string integrator : {"integrator whitted", "integrator path"}) {
        const RayCounts rays = seen(integrator, glow + kFloor + lamp("translate 0 0 4")).rays;
        CHECK_EQUAL(rays.points, kPoints);
        CHECK_EQUAL(rays.skipped.unshadedPoints, kPoints);
        CHECK_EQUAL(rays.total(), kPoints);
        CHECK_EQUAL(seen(integrator, kPlain + kFloor).rays.skipped.unshadedPoints, 0u);
    }
}

TEST(skipped_rays_are_those_below_the_cutoff) {
    const auto counts = [](const std::string& mirror) {
        return seen("cutoff 0.01", "material m {\n diffuse 0 0 0\n mirror " + mirror + "\n}\n" + kFloor).rays;
    };
    const RayCounts weak = counts("0.009 0.009 0.009"), strong = counts("0 0 0.011");
    CHECK_EQUAL(weak.skipped.weakRays, kPoints);
    CHECK_EQUAL(weak.reflect, 0u);
    CHECK_EQUAL(strong.skipped.weakRays, 0u);
    CHECK_EQUAL(strong.reflect, kPoints);
}

// From within glass, at 60 degrees to the normal, mirror and refraction lead the same way.
TEST(skipped_rays_of_total_reflection) {
    const RayCounts rays =
        shot::render("settings {\n resolution 8 8\n samples 1\n max_depth 1\n}\n"
                     "camera c {\n type orthographic\n ortho_scale 1\n look_at -1.7320508 0 -1  0 0 0  0 0 1\n}\n"
                     "material m {\n diffuse 0 0 0\n mirror 0.5 0.5 0.5\n transmission 0.5 0.5 0.5\n"
                     " ior 1.5\n}\n" +
                     kFloor)
            .stats.rays;
    CHECK_EQUAL(rays.points, kPoints);
    CHECK_EQUAL(rays.skipped.sharedRays, kPoints);
    CHECK_EQUAL(rays.reflect + rays.refract, kPoints);
}

// Paths between two plates, longer and longer: roulette begins after three bounces.
TEST(skipped_paths_are_ended_by_roulette) {
    const std::string plates = kPlain + "plane p {\n scale 900 900 1\n material m\n}\n"
                               "plane q {\n translate 0 0 20\n scale 900 900 1\n material m\n}\n";
    const auto counts = [&](const std::string& depth) {
        return seen("integrator path\n diffuse_depth 9\n max_depth " + depth, plates + lamp("translate 0 0 4")).rays;
    };
    CHECK_EQUAL(counts("3").skipped.endedPaths, 0u);
    const RayCounts deep = counts("4"), more = counts("9");
    // Some of the fourth bounces of paths are ended, whatever comes after; the last bounce is not traced, as
    // nothing that rays meet shines.
    CHECK(deep.skipped.endedPaths > 0);
    CHECK(more.skipped.endedPaths > deep.skipped.endedPaths);
    CHECK(more.indirect > deep.indirect);
}

TEST(skipped_pictures_are_counted_by_their_files) {
    shot::writeTexture("shown.pfm", 4, 2, [](double, double) { return Rgb{1, 1, 1}; });
    shot::writeTexture("hidden.pfm", 8, 8, [](double, double) { return Rgb{1, 1, 1}; });
    const SceneDesc desc = shot::parse(
        "camera c {\n}\ntexture a {\n file shown.pfm\n}\ntexture b {\n file hidden.pfm\n}\ntexture c {\n file shown.pfm\n}\n"
        "texture lost {\n file lost.pfm\n}\nmaterial m {\n diffuse_texture a\n}\n");
    const std::filesystem::path folder(shot::textureFolder());
    const std::uintmax_t shown = std::filesystem::file_size(folder / "shown.pfm"),
                         hidden = std::filesystem::file_size(folder / "hidden.pfm");
    const PictureBytes bytes = pictureBytes(desc, usedTextures(desc, true), "test.txt", folder.string());
    CHECK_EQUAL(bytes.shown, shown);
    CHECK_EQUAL(bytes.unshown, hidden);
    CHECK_EQUAL(pictureBytes(desc, {}, "test.txt", folder.string()).unshown, shown + hidden);
}

} // namespace test_skipped
