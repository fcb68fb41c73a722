// --error: promise P5. The estimated error against the true one, over scenes with every source of
// noise; the bits; what it saves.
#include "check.h"
#include "scenes.h"
#include "shot.h"

#include "accel/kernels/kernels.h"
#include "image/colour.h"
#include "image/compare.h"
#include "sample/hash.h"

#include <algorithm>

namespace test_error {

namespace {

shot::Tweak goal(double rmse, const shot::Tweak& more = {}) {
    return [=](RenderSettings& s) {
        s.picture.samplesPerPixel = Refinement::kFirstSamples;
        s.refinement = Refinement{.error = rmse};
        s.aovs = {Aov::Error};
        if (more) more(s);
    };
}

// Small pictures, for many samples.
void shrink(RenderSettings& s) {
    s.picture.width = 48, s.picture.height = 36;
    s.isa = &bestIsa();
}

Picture render(const std::string& text, const shot::Tweak& tweak, Stats& stats) {
    RenderSettings settings;
    const SceneDesc desc = shot::parse(text);
    settings.picture = desc.settings;
    shrink(settings);
    tweak(settings);
    const SourceFile source{"scene", text};
    settings.textureFolder = shot::textureFolder();
    const Scene scene(desc, source, settings);
    return ::render(scene, settings, {}, stats);
}
Picture render(const std::string& text, const shot::Tweak& tweak) {
    Stats stats;
    return render(text, tweak, stats);
}

const std::string& sceneNamed(const std::string& name) {
    const auto& all = scenes::all();
    return std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; })
        ->text;
}

// What the picture is without noise, nearly: with another seed, and `samples` everywhere.
Image referenceOf(const std::string& text, int samples, const shot::Tweak& tweak = {}) {
    return render(text,
                  [&](RenderSettings& s) {
                      if (tweak) tweak(s);
                      s.picture.sampler = SettingsDesc::Sampler::Sobol;
                      s.picture.samplesPerPixel = samples;
                      s.picture.seed = 99;
                  })
        .color;
}

// RMSE over the pixels of a rectangle, of two pictures as they are.
double rmseIn(const Image& a, const Image& b, int x0, int y0, int side) {
    double sum = 0;
    int count = 0;
    for (int y = y0; y < std::min(y0 + side, a.height()); ++y)
        for (int x = x0; x < std::min(x0 + side, a.width()); ++x, count += 3) {
            const Rgb p = a.pixel(x, y), q = b.pixel(x, y);
            sum += sqr(static_cast<double>(p.r - q.r)) + sqr(static_cast<double>(p.g - q.g)) +
                   sqr(static_cast<double>(p.b - q.b));
        }
    return std::sqrt(sum / count);
}

// The picture as it is shown: clipped, and in sRGB.
Image shown(Image image) {
    for (Rgb& p : image.pixels())
        p = {srgbFromLinear(p.r), srgbFromLinear(p.g), srgbFromLinear(p.b)};
    return image;
}
const Image& errorOf(const Picture& picture) { return picture.aovs.back().image; }

} // namespace

// Soft shadows, rough mirrors, a lens, motion, textures, glass, see-through surfaces: the true error as shown is
// below the goal and, but where the first look is already better, not below half of it; in blocks of 32 x 32 it is at
// most 1.1 of the reported one in 95 % (E1 and E2). The reference has another seed and an error of less than a tenth.
TEST(reportedErrorIsHonest) {
    int blocks = 0, honest = 0;
    double worst = 0;
    for (const char* name :
         {"soft", "glossy", "dof", "motion", "textures", "glass", "transparent"}) {
        const std::string& text = sceneNamed(name);
        const Image reference = shown(referenceOf(text, 1024));
        for (std::uint32_t seed = 0; seed < check::scaled(2u); ++seed) {
            Stats stats;
            const Picture picture =
                render(text, goal(0.02, [&](RenderSettings& s) { s.picture.seed = seed; }), stats);
            const Image seen = shown(picture.color);
            const double truth = rmse(seen, reference);
            CHECK_INFO(stats.error->estimate <= 0.02, name << " " << stats.error->estimate);
            CHECK_INFO(truth <= stats.error->estimate, name << " seed " << seed << ": " << truth
                                                            << ", reported "
                                                            << stats.error->estimate);
            CHECK_INFO(truth > 0.01 || stats.samplesMean < 20, name << " " << truth);
            worst = max(worst, truth / stats.error->estimate);
            const Image none(seen.width(), seen.height());
            constexpr int kSide = 32;
            for (int y = 0; y < seen.height(); y += kSide)
                for (int x = 0; x < seen.width(); x += kSide, ++blocks)
                    honest += rmseIn(seen, reference, x, y, kSide) <=
                              1.1 * rmseIn(errorOf(picture), none, x, y, kSide) + 1e-4;
        }
    }
    std::printf("true error at most %.2f of the reported one; %d of %d blocks within 1.1\n", worst,
                honest, blocks);
    CHECK_INFO(honest >= 0.95 * blocks, honest << " of " << blocks);
}

// The same error with the same number of samples everywhere costs more: what moves is in a part of
// the picture only.
TEST(errorGoalSavesSamples) {
    const std::string& text = sceneNamed("motion");
    const Image reference = shown(referenceOf(text, 1024));
    const auto evenError = [&](int samples) {
        return rmse(
            shown(render(text, [&](RenderSettings& s) { s.picture.samplesPerPixel = samples; }).color),
            reference);
    };
    Stats stats;
    const double error = rmse(shown(render(text, goal(0.005), stats).color), reference);
    int samples = 4;
    double before = evenError(samples / 2), now = evenError(samples);
    for (; now > error && samples < 256; samples *= 2) before = now, now = evenError(2 * samples);
    // Between two powers of two, on straight lines of the logarithms.
    const double needed =
        samples / 2 * std::exp2(std::log(before / error) / std::log(before / now));
    std::printf("%.1f samples per pixel instead of %.1f\n", stats.samplesMean, needed);
    CHECK_INFO(needed > 1.4 * stats.samplesMean, stats.samplesMean << " of " << needed);
}

// Pixels do not stop where they are too dark by chance: the mean over many seeds of every block is that of a
// reference, as far as their spread tells (E3: |z| below 4.5, and the mean of all z below 4.5 / sqrt(blocks)).
TEST(errorGoalIsNotBiased) {
    const std::string& text = sceneNamed("glossy");
    const int seeds = check::scaled(48);
    const Image reference = referenceOf(text, 8192);
    constexpr int kSide = 12;
    std::vector<std::vector<double>> means; // of blocks, per seed
    const auto blocksOf = [&](const Image& image) {
        std::vector<double> all;
        for (int y = 0; y < image.height(); y += kSide)
            for (int x = 0; x < image.width(); x += kSide) {
                double sum = 0;
                for (int j = y; j < y + kSide; ++j)
                    for (int i = x; i < x + kSide; ++i) {
                        const Rgb p = image.pixel(i, j);
                        sum += static_cast<double>(p.r) + static_cast<double>(p.g) +
                               static_cast<double>(p.b);
                    }
                all.push_back(sum);
            }
        return all;
    };
    for (int seed = 0; seed < seeds; ++seed)
        means.push_back(blocksOf(render(text, goal(0.02, [&](RenderSettings& s) {
                                            s.picture.seed = static_cast<std::uint32_t>(seed);
                                        })).color));
    const std::vector<double> right = blocksOf(reference);
    double sumOfZ = 0;
    for (std::size_t b = 0; b < right.size(); ++b) {
        double sum = 0, squares = 0;
        for (const auto& one : means) sum += one[b];
        const double mean = sum / seeds;
        for (const auto& one : means) squares += sqr(one[b] - mean);
        const double z = (mean - right[b]) / std::sqrt(squares / (seeds - 1.0) / seeds + 1e-12);
        CHECK_INFO(std::fabs(z) < 4.5, "block " << b << ": z " << z);
        sumOfZ += z;
    }
    const auto count = static_cast<double>(right.size());
    CHECK_INFO(std::fabs(sumOfZ / count) < 4.5 / std::sqrt(count), sumOfZ / count);
}

// Promise P1: what is chosen comes from the picture, and nothing else.
TEST(errorGoalHasTheSameBits) {
    for (const char* name : {"dof", "textures"}) {
        const std::string& text = sceneNamed(name);
        Stats stats;
        const Picture one = render(text, goal(0.01), stats);
        CHECK(stats.samplesMax > stats.samplesMin);
        const auto same = [&](const std::string& what, const shot::Tweak& tweak) {
            Stats other;
            const Picture picture = render(text, goal(0.01, tweak), other);
            CHECK_INFO(shot::differingPixels(one.color, picture.color) == 0, name << " " << what);
            CHECK_INFO(shot::differingPixels(errorOf(one), errorOf(picture)) == 0, name << " " << what);
            CHECK_EQUAL(other.samplesMean, stats.samplesMean);
            CHECK_EQUAL(other.error->estimate, stats.error->estimate);
        };
        for (const int threads : {2, 3, 8})
            same(cat(threads, " threads"), [&](RenderSettings& s) { s.threads = threads; });
        for (const int side : {1, 7, 64})
            same(cat("tiles of ", side), [&](RenderSettings& s) { s.tileSide = side; });
        same("short chunks", [](RenderSettings& s) { s.chunkSamples = 50; });
        same("every step", [](RenderSettings& s) { s.specialise = false; });
        same("no tree", [](RenderSettings& s) { s.accel = AccelKind::None; });
        same("the best kernel", [](RenderSettings& s) { s.isa = &bestIsa(); });
    }
}

// Every sampler and integrator keeps what it says; samples beyond a pattern are fresh ones. The first half of a grid
// is one side of the pixel, which makes its first look four times too careful.
TEST(errorGoalsOfAllMethods) {
    const std::string& text = sceneNamed("soft");
    using Sampler = SettingsDesc::Sampler;
    const auto isMet = [&](const std::string& what, const Image& reference,
                           const shot::Tweak& tweak) {
        Stats stats;
        const Image image = shown(render(text, goal(0.03, tweak), stats).color);
        const double truth = rmse(image, shown(reference));
        CHECK_INFO(truth <= 1.05 * stats.error->estimate && truth > 0.2 * stats.error->estimate,
                   what << ": " << truth << ", reported " << stats.error->estimate);
    };
    const Image picture = referenceOf(text, 128);
    for (const Sampler sampler :
         {Sampler::Sobol, Sampler::Stratified, Sampler::Random, Sampler::Grid})
        isMet(cat("sampler ", static_cast<int>(sampler)), picture,
              [=](RenderSettings& s) { s.picture.sampler = sampler; });
    for (const IntegratorKind kind : {IntegratorKind::Ao, IntegratorKind::Normal}) {
        const auto tweak = [=](RenderSettings& s) { s.picture.integrator = kind; };
        isMet(cat("integrator ", static_cast<int>(kind)), referenceOf(text, 128, tweak), tweak);
    }
    const auto box = [](RenderSettings& s) {
        s.picture.filter = SettingsDesc::Filter::Box;
        s.picture.filterWidth = 1;
    };
    isMet("a box filter", referenceOf(text, 128, box), box);
}

// The units: linear errors are of the picture with its exposure, so 2 EV more and 4 times the error is the same
// picture to the bit; as shown, white is white, however bright it is; relative ones are against the light.
TEST(errorHasUnits) {
    const std::string& text = sceneNamed("dof");
    const auto linear = [](RenderSettings& s) { s.refinement->unit = ErrorUnit::Linear; };
    const Picture one = render(text, goal(0.02, linear));
    const Picture bright = render(text, goal(0.08, [&](RenderSettings& s) {
                                      linear(s), s.picture.exposureEv += 2;
                                  }));
    CHECK_EQUAL(shot::differingPixels(one.color, bright.color), 0);

    const std::string lamp =
        "settings {\n resolution 32 32\n}\ncamera c {\n type orthographic\n "
        "ortho_scale 4\n translate 0 0 5\n}\nmaterial w {\n emission 50 50 50\n"
        " diffuse 0 0 0\n}\nsphere s {\n material w\n}\n";
    const auto meanOf = [&](ErrorUnit unit, double ev) {
        Stats stats;
        render(lamp, goal(0.02, [&](RenderSettings& s) {
                              s.refinement->mostSamples = 4096, s.refinement->unit = unit;
                              s.picture.exposureEv = ev;
                          }), stats);
        return stats.samplesMean;
    };
    const double display = meanOf(ErrorUnit::Display, 0), all = meanOf(ErrorUnit::Linear, 0);
    CHECK_INFO(display < 0.8 * all, display << " of " << all);
    // Where light is far above 0.1 the exposure does not count.
    const double relative = meanOf(ErrorUnit::Relative, 0);
    CHECK_NEAR(meanOf(ErrorUnit::Relative, 2), relative, 0.4 * relative); // samples double or do not
    CHECK(meanOf(ErrorUnit::Linear, -4) < 0.5 * all);
}

// A goal for the worst block has the same bits in a crop of whole blocks as in the whole picture; so has a fixed
// number of passes whatever the threads.
TEST(errorGoalsOfBlocksMayBeCropped) {
    const std::string& text = sceneNamed("dof");
    const auto worst = [](RenderSettings& s) { s.refinement->ofWorstBlock = true; };
    const Picture all = render(text, goal(0.03, worst));
    const Picture part = render(text, goal(0.03, [&](RenderSettings& s) {
                                    worst(s), s.picture.crop = {{0, 0, 32, 32}};
                                }));
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) CHECK(all.color.pixel(x, y) == part.color.pixel(x, y));
    const auto passes = [&](int threads) {
        return render(text, goal(0, [=](RenderSettings& s) {
                          s.refinement = Refinement{.passes = 9}, s.threads = threads;
                      })).color;
    };
    CHECK_EQUAL(shot::differingPixels(passes(1), passes(5)), 0);
}

// The clock ends a picture after whole passes, which as many passes without a clock repeat.
TEST(timeDecidesTheNumberOfPasses) {
    const std::string& text = sceneNamed("dof");
    int calls = 0;
    const auto secondsLeft = [&] { return 10.0 - ++calls; };
    RenderSettings settings;
    const SceneDesc desc = shot::parse(text);
    settings.picture = desc.settings;
    shrink(settings);
    settings.picture.samplesPerPixel = Refinement::kFirstSamples;
    settings.refinement = Refinement{.hasTime = true};
    settings.textureFolder = shot::textureFolder();
    const SourceFile source{"scene", text};
    const Scene scene(desc, source, settings);
    Stats stats, again;
    RenderControl control;
    control.secondsLeft = secondsLeft;
    const Picture timed = ::render(scene, settings, control, stats);
    CHECK(stats.error->passes >= 2 && stats.error->passes < 6);
    settings.refinement = Refinement{.passes = stats.error->passes};
    const Picture repeated = ::render(scene, settings, {}, again);
    CHECK_EQUAL(shot::differingPixels(timed.color, repeated.color), 0);
    CHECK_EQUAL(stats.samplesMean, again.samplesMean);
}

// A thousand balls of an eighth of a pixel, which a look of 16 samples misses three times of four: every one of them is
// in the picture.
TEST(thinThingsAreMet) {
    int missed = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        std::vector<Vec2d> places; // 7 pixels apart, moved at random
        std::string text = "settings {\n resolution 70 35\n}\ncamera c {\n type orthographic\n ortho_scale 70\n "
                           "translate 0 0 5\n}\nmaterial w {\n emission 1 1 1\n diffuse 0 0 0\n}\n";
        for (int i = 0; i < 50; ++i) {
            const auto at = [&](std::uint32_t axis) {
                const auto place = static_cast<std::uint32_t>(i);
                return 0.5 + 6 * static_cast<double>(unitFloat(low32(hash(seed, place, axis))));
            };
            const Vec2d p{7 * (i % 10) + at(0), 7 * (i / 10) + at(1)};
            places.push_back(p);
            text += cat("sphere s", i, " {\n material w\n radius 0.0625\n translate ", p.x - 35, " ", 17.5 - p.y,
                        " 0\n}\n");
        }
        const Image image = render(text, goal(0.05, [&](RenderSettings& s) {
                                       s.picture.width = 70, s.picture.height = 35;
                                       s.picture.seed = seed;
                                   })).color;
        for (const Vec2d p : places) {
            float light = 0;
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x)
                    light += image.pixel(std::clamp(static_cast<int>(p.x) + x, 0, 69),
                                         std::clamp(static_cast<int>(p.y) + y, 0, 34)).r;
            missed += !(light > 0);
        }
    }
    CHECK_EQUAL(missed, 0);
}

// Pictures beside it count and average the same samples, empty parts of the picture included.
TEST(errorGoalCountsItsSamples) {
    Stats stats;
    const Picture picture = render(sceneNamed("motion"),
                                   goal(0.01,
                                        [](RenderSettings& s) {
                                            s.aovs = {Aov::Samples, Aov::Depth, Aov::Id, Aov::Error};
                                            s.picture.crop = {{3, 5, 40, 31}};
                                        }),
                                   stats);
    const Image& counts = picture.aovs[0].image;
    CHECK_EQUAL(counts.width(), 37);
    CHECK_EQUAL(picture.color.height(), 26);
    CHECK_NEAR(shot::estimate(counts).mean, stats.samplesMean, 1e-9 * stats.samplesMean);
    CHECK_EQUAL(shot::largest(counts), stats.samplesMax);
    CHECK_EQUAL(shot::smallest(counts), stats.samplesMin);
    CHECK_NEAR(static_cast<double>(stats.rays.camera), stats.samplesMean * 37 * 26, 1e-6);
    for (const Rgb p : picture.aovs[2].image.pixels()) CHECK_EQUAL(p.r, std::floor(p.r));

    Stats sky;
    const Image image = render("camera c {\n look_at 0 0 0  0 0 1 "
                               " 0 1 0\n}\nworld {\n background 0.1 0.3 0.7\n}\n",
                               goal(1e-6), sky)
                            .color;
    CHECK_EQUAL(sky.samplesMax, Refinement::kFirstSamples);
    CHECK_EQUAL(sky.error->estimate, 0.0);
    for (const Rgb p : image.pixels()) CHECK(p == (Rgb{0.1f, 0.3f, 0.7f}));
}

} // namespace test_error
