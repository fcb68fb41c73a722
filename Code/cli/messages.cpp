#include "cli/messages.h"

#include "base/enum_names.h"
#include "base/platform/platform.h"
#include "base/text.h"
#include "cli/advice.h"
#include "cli/output.h"
#include "cli/stats_output.h"
#include "desc/enum_tables.h"

#include <bit>
#include <cstdio>

void writeStderr(std::string_view text) {
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

void printWarnings(const Diagnostics& diagnostics) {
    for (const std::string& warning : diagnostics.warnings) writeStderr(warning + "\n");
}

bool isTooStrict(const Options& options, const Diagnostics& diagnostics) {
    const std::size_t count = diagnostics.warnings.size();
    if (!options.strict || count == 0) return false;
    writeStderr(cat("raytracer: error: ", count, count == 1 ? " warning" : " warnings",
                    " under --strict\n"));
    return true;
}

void printAdvice(const RenderSettings& settings, const Options& options) {
    using Sampler = SettingsDesc::Sampler;
    const auto samples = static_cast<unsigned>(settings.picture.samplesPerPixel);
    const Sampler sampler = settings.picture.sampler;
    if (!options.quiet && settings.picture.denoise && samples < 8)
        writeStderr("raytracer: note: fewer than 8 samples per pixel hardly tell noise from "
                    "what is seen; --denoise works better with more\n");
    if (options.quiet || (sampler != Sampler::Sobol && sampler != Sampler::ZSobol) ||
        std::has_single_bit(samples))
        return;
    writeStderr(cat("raytracer: note: ", samples, " samples per pixel with ", nameOf(sampler),
                    "; a power of two (", std::bit_ceil(samples), ") has less noise\n"));
}

void printShortfall(const Stats& stats, const RenderSettings& settings, const Options& options) {
    if (options.quiet || !stats.error) return;
    const ErrorStats& error = *stats.error;
    if (settings.picture.denoise && !stats.denoisedError)
        writeStderr("raytracer: note: the picture is not denoised: some of its pixels have had one pass, "
                    "which does not show their noise\n");
    if (error.goal && error.estimate > *error.goal && error.cappedPixels > 0)
        writeStderr(cat("raytracer: note: the estimated error is ", significant(error.estimate),
                        ", not below ", shortest(*error.goal), ": ", error.cappedPixels,
                        " pixels would need more than ", error.mostSamples,
                        " samples; --spp allows more\n"));
    if (error.unsureBlocks > 0)
        writeStderr(cat("raytracer: note: in ", error.unsureBlocks,
                        " blocks of 32 x 32 pixels one sample is a tenth of the light or more: others "
                        "like it may be missing, which no estimate can know\n"));
    if (options.seconds)
        writeStderr(cat("raytracer: note: the time was enough for ", error.passes,
                        error.passes == 1 ? " pass" : " passes", "; --passes ", error.passes,
                        " gives the same picture\n"));
}

void printExposure(const Picture& picture, const Scene& scene, const RenderSettings& settings,
                   const std::string& output) {
    if (settings.picture.integrator != IntegratorKind::Whitted) return;
    std::optional<Rgb> white = scene.background(Vec3{0, 0, 1});
    if (scene.environment() || maxChannel(*white) > 1) white.reset();
    const std::string extension = lowerExtension(output);
    if (const auto advice =
            adviceOn(levelsOf(picture, settings, white), settings.picture.exposureEv,
                     extension == ".exr" || extension == ".pfm"))
        writeStderr(*advice + "\n");
}

void printPreview(const Picture& picture, const RenderSettings& settings) {
    Image image = picture.color;
    expose(image, settings.picture.exposureEv);
    const Terminal terminal = terminalOfStderr();
    constexpr int kPromptRows = 2; // what was typed, and the prompt that follows
    writeStderr(previewText(image, terminal.columns, terminal.rows - kPromptRows));
}

void printStats(const Stats& stats, const RunFacts& run, const Options& options) {
    if (options.stats == Options::StatsFormat::Table) writeStderr(statsTable(stats));
    if (options.stats == Options::StatsFormat::Json) writeStdout(statsJson(stats, run));
}
