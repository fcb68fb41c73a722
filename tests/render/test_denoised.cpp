// --denoise on rendered pictures: the samples are those of the picture without it, its error is the one that is
// told, and no scene gets worse.
#include "check.h"
#include "scenes.h"
#include "shot.h"

#include "image/colour.h"
#include "image/compare.h"

#include <algorithm>
#include <array>

namespace test_denoised {

namespace {

const std::string& sceneNamed(const std::string& name) {
    const auto& all = scenes::all();
    return std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; })->text;
}

Picture render(const std::string& text, int samples, Stats& stats, const shot::Tweak& tweak = {}) {
    RenderSettings settings;
    const SceneDesc desc = shot::parse(text);
    settings.picture = desc.settings;
    settings.picture.width = 96, settings.picture.height = 72;
    settings.picture.sampler = SettingsDesc::Sampler::Sobol;
    settings.picture.samplesPerPixel = samples;
    settings.isa = &bestIsa();
    settings.textureFolder = shot::textureFolder();
    if (tweak) tweak(settings);
    const SourceFile source{"scene", text};
    const Scene scene(desc, source, settings);
    return ::render(scene, settings, {}, stats);
}

Image shown(Image image) {
    for (Rgb& p : image.pixels())
        p = {srgbFromLinear(p.r), srgbFromLinear(p.g), srgbFromLinear(p.b)};
    return image;
}

} // namespace

// In passes of doublings every pixel gets its samples and no others, also of a number that is no power of two.
TEST(samplesToDenoiseAreThoseOfThePlainPicture) {
    for (const char* name : {"soft", "textures", "dof"})
        for (const int samples : {4, 8, 13}) {
            Stats stats, evenStats;
            const Picture plain = render(sceneNamed(name), samples, stats);
            const Picture even = render(sceneNamed(name), samples, evenStats, [&](RenderSettings& s) {
                s.refinement = Refinement{.mostSamples = samples, .evenDoublings = 3};
            });
            CHECK_INFO(even.color == plain.color, name << ", " << samples << " samples");
            CHECK_EQUAL(evenStats.samplesMin, samples);
            CHECK_EQUAL(evenStats.samplesMax, samples);
            CHECK_EQUAL(evenStats.rays.camera, stats.rays.camera);
        }
}

TEST(denoisedPicturesTellTheirError) {
    for (const char* name : {"soft", "glossy", "dof", "motion", "textures", "glass"}) {
        Stats stats, rawStats;
        const std::string& text = sceneNamed(name);
        const Image reference = shown(
            render(text, 1024, stats, [](RenderSettings& s) { s.picture.seed = 99; }).color);
        const double raw = rmse(shown(render(text, 32, rawStats).color), reference);
        const Picture picture =
            render(text, 32, stats, [](RenderSettings& s) { s.picture.denoise = true; });
        const double error = rmse(shown(picture.color), reference);
        CHECK(picture.aovs.empty());
        CHECK_INFO(error < 1.02 * raw, name << ": " << error << ", raw " << raw);
        CHECK_INFO(*stats.denoisedError > 0.75 * error && *stats.denoisedError < 1.3 * error,
                   name << ": " << error << ", told " << *stats.denoisedError);
    }
}

// Also where errors decide which pixels get samples.
TEST(refinedPicturesAreDenoised) {
    Stats stats, denoisedStats;
    const std::string& text = sceneNamed("soft");
    const auto refined = [](bool denoise) {
        return [denoise](RenderSettings& s) {
            s.refinement = Refinement{.error = 0.02};
            s.picture.denoise = denoise;
        };
    };
    const Image reference =
        shown(render(text, 1024, stats, [](RenderSettings& s) { s.picture.seed = 99; }).color);
    const double raw = rmse(shown(render(text, 16, stats, refined(false)).color), reference);
    const double error = rmse(shown(render(text, 16, denoisedStats, refined(true)).color), reference);
    CHECK_EQUAL(denoisedStats.samplesMean, stats.samplesMean);
    CHECK_INFO(error < 1.02 * raw, error << " of " << raw);
    CHECK(*denoisedStats.denoisedError < denoisedStats.error->estimate);
}

} // namespace test_denoised
