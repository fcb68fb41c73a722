#include "cli/settings_from.h"

#include "base/enum_names.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "cli/output.h"
#include "desc/enum_tables.h"
#include "desc/names.h"
#include "image/image.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace {

// The whole support that the filter is known for: a box of one pixel, a tent from centre to centre,
// and what Cycles starts with.
double usualWidth(SettingsDesc::Filter filter) {
    switch (filter) {
    case SettingsDesc::Filter::Box: return 1;
    case SettingsDesc::Filter::Tent: return 2;
    case SettingsDesc::Filter::Gaussian:
    case SettingsDesc::Filter::BlackmanHarris: break;
    }
    return 1.5;
}

// Rounded down, as Blender's resolution percentage.
int scaledSide(int side, double percent) {
    const double scaled = std::floor(side * percent / 100);
    if (scaled > Image::kMaxSide)
        failUsage(cat("--scale ", shortest(percent), " makes a picture ", shortest(scaled),
                      " pixels wide or high; at most ", Image::kMaxSide, " are possible"));
    return std::max(1, static_cast<int>(scaled));
}

// The scene's crop, for another resolution: the smallest rectangle that has all of it.
std::array<int, 4> movedCrop(const std::array<int, 4>& crop, const SettingsDesc& from, int width,
                             int height) {
    const double x = static_cast<double>(width) / from.width;
    const double y = static_cast<double>(height) / from.height;
    return {static_cast<int>(std::floor(crop[0] * x)), static_cast<int>(std::floor(crop[1] * y)),
            std::min(width, static_cast<int>(std::ceil(crop[2] * x))),
            std::min(height, static_cast<int>(std::ceil(crop[3] * y)))};
}

void setPictureSize(SettingsDesc& picture, const Options& options) {
    const SettingsDesc written = picture;
    if (options.resolution) {
        picture.width = (*options.resolution)[0];
        picture.height = (*options.resolution)[1];
    }
    picture.width = scaledSide(picture.width, options.scalePercent);
    picture.height = scaledSide(picture.height, options.scalePercent);
    if (options.crop)
        picture.crop = options.crop;
    else if (picture.crop)
        picture.crop = movedCrop(*picture.crop, written, picture.width, picture.height);
    if (options.crop && ((*picture.crop)[2] > picture.width || (*picture.crop)[3] > picture.height))
        failUsage(cat("--crop reaches to ", (*picture.crop)[2], ",", (*picture.crop)[3],
                      ", but the picture has ", picture.width, "x", picture.height, " pixels"));
}

void setQuality(SettingsDesc& picture, const Options& options) {
    const auto set = [](auto& to, const auto& from) {
        if (from) to = *from;
    };
    set(picture.samplesPerPixel, options.samplesPerPixel);
    set(picture.lightSamples, options.lightSamples);
    set(picture.integrator, options.integrator);
    set(picture.maxDepth, options.maxDepth);
    set(picture.diffuseDepth, options.diffuseDepth);
    set(picture.glossyDepth, options.glossyDepth);
    set(picture.transmissionDepth, options.transmissionDepth);
    set(picture.transparentDepth, options.transparentDepth);
    set(picture.filterGlossy, options.filterGlossy);
    set(picture.clampIndirect, options.clampIndirect);
    set(picture.caustics, options.caustics);
    set(picture.denoise, options.denoise);
    set(picture.sampler, options.sampler);
    set(picture.textureFilter, options.textureFilter);
    // Corners lie apart already; more samples serve lights, lens and motion only.
    if (options.sampler == SettingsDesc::Sampler::Corners && !options.samplesPerPixel)
        picture.samplesPerPixel = 1;
    set(picture.jitter, options.jitter);
    set(picture.seed, options.seed);
    if (options.filter) {
        picture.filter = *options.filter;
        picture.filterWidth = options.filterWidth.value_or(usualWidth(*options.filter));
    }
    set(picture.exposureEv, options.exposureEv);
    set(picture.transfer, options.transfer);
    if (options.switches.aa) return;
    // All samples in the centre of the pixel: one is enough, unless lights or lens need more.
    if (picture.sampler == SettingsDesc::Sampler::Corners)
        picture.sampler = SettingsDesc::Sampler::Grid;
    picture.samplesPerPixel = options.samplesPerPixel.value_or(1);
    picture.jitter = false;
    picture.filter = SettingsDesc::Filter::Box;
    picture.filterWidth = 0;
}

// Halves of the samples of each pixel, and what they come to when they double, show what is noise.
void checkDenoising(SettingsDesc& picture, const Options& options) {
    if (!picture.denoise) return;
    using Integrator = SettingsDesc::Integrator;
    const Integrator shown = picture.integrator;
    if (shown != Integrator::Whitted && shown != Integrator::Path && shown != Integrator::Ao) {
        if (options.denoise)
            failUsage(cat("--denoise has no use with the integrator ", nameOf(shown),
                          ", whose picture has no light in it"));
        picture.denoise = false; // the scene means its picture of light
        return;
    }
    const bool isRefined = options.error || options.seconds || options.passes;
    if (!isRefined && picture.samplesPerPixel < 4)
        failUsage(cat("--denoise needs 4 or more samples per pixel, not ", picture.samplesPerPixel,
                      ": their differences show what is noise; --spp 4 or --no-denoise helps"));
}

// All samples of a picture are one sequence along the Z-order of a square, whose numbers have 32
// bits.
void checkSampleNumbers(const SettingsDesc& picture) {
    if (picture.sampler != SettingsDesc::Sampler::ZSobol) return;
    const auto bitsOf = [](int count) {
        return static_cast<int>(std::bit_width(static_cast<unsigned>(count) - 1));
    };
    const int left = 32 - 2 * bitsOf(std::max(picture.width, picture.height));
    if (bitsOf(picture.samplesPerPixel) <= left) return;
    const std::string most = left < 0 ? "no" : cat("at most ", std::uint64_t{1} << left);
    failUsage(cat("the sampler zsobol numbers all samples of a picture by 32 bits: one of ",
                  picture.width, "x", picture.height, " pixels can have ", most,
                  " samples per pixel, not ", picture.samplesPerPixel,
                  "; --sampler sobol can have any number"));
}

// The scene's own number of samples says how good its picture shall be, and so do these options.
void setRefinement(RenderSettings& settings, const Options& options) {
    const auto wantsError =
        std::find(options.aovs.begin(), options.aovs.end(), Aov::Error) != options.aovs.end();
    if (options.action != Options::Action::Render) return;
    if (!options.error && !options.seconds && !options.passes) {
        if (wantsError)
            failUsage("--aov error needs --error, --time or --passes, which estimate it");
        return;
    }
    const std::string flag = options.error ? "--error" : options.seconds ? "--time" : "--passes";
    using Sampler = SettingsDesc::Sampler;
    SettingsDesc& picture = settings.picture;
    const bool hasPlaces =
        picture.sampler == Sampler::Stratified || picture.sampler == Sampler::Grid;
    if (picture.sampler == Sampler::Corners)
        failUsage(flag + " has no use with --sampler corners, whose rays have fixed places; sobol, "
                         "stratified, random and grid go on with more");
    if (picture.sampler == Sampler::ZSobol)
        failUsage(flag + " has no use with --sampler zsobol, whose pixels are not independent: errors "
                         "that neighbours share cannot be told from the picture; sobol, "
                         "stratified, random and grid go on with more");
    if (hasPlaces && !picture.jitter && picture.filterWidth > 0)
        failUsage(flag + " has no use with --no-jitter: samples in fixed places do not know what "
                         "is between them; --sampler sobol and random need no jitter");
    if (options.seconds && options.passes)
        failUsage("--time and --passes both say when the picture ends; give one of them");
    Refinement refinement{.error = options.error,
                          .unit = options.errorUnit,
                          .ofWorstBlock = options.errorOfWorstBlock,
                          .hasTime = options.seconds.has_value(),
                          .passes = options.passes};
    refinement.mostSamples = options.samplesPerPixel.value_or(refinement.mostSamples);
    if (refinement.mostSamples < 2)
        failUsage(flag + " needs --spp 2 or more: one sample shows no error");
    picture.samplesPerPixel = Refinement::kFirstSamples;
    settings.refinement = refinement;
}

} // namespace

RenderSettings settingsFrom(const SceneDesc& desc, const Options& options) {
    RenderSettings settings;
    settings.picture = desc.settings;
    setPictureSize(settings.picture, options);
    setQuality(settings.picture, options);
    if (!options.camera.empty()) {
        std::vector<std::string> known;
        for (const CameraDesc& camera : desc.cameras) known.push_back(shown(camera.name));
        if (std::find(known.begin(), known.end(), options.camera) == known.end())
            failUsage("unknown camera " + unknownName(options.camera, known));
    }
    settings.camera = options.camera;
    settings.switches = options.switches;
    settings.accel = options.accel;
    settings.specialise = options.specialise;
    settings.isa = &chooseKernel(options.kernel);
    settings.threads = options.threads > 0 ? options.threads : hardwareThreads();
    settings.background = options.background;
    settings.aovs = options.aovs;
    if (options.action != Options::Action::Convert)
        checkDenoising(settings.picture, options);
    setRefinement(settings, options);
    checkSampleNumbers(settings.picture);
    settings.textureFolder = options.textureFolder;
    return settings;
}

SceneDesc withSettings(SceneDesc desc, const RenderSettings& settings) {
    desc.settings = settings.picture;
    if (settings.background) desc.world.background = *settings.background;
    // The first camera is the active one.
    const auto active =
        std::find_if(desc.cameras.begin(), desc.cameras.end(),
                     [&](const CameraDesc& camera) { return camera.name == settings.camera; });
    if (active != desc.cameras.end()) std::rotate(desc.cameras.begin(), active, active + 1);
    return desc;
}

std::vector<std::string> kernelNames() {
    std::vector<std::string> names;
    for (const Isa& isa : allIsas()) names.emplace_back(isa.name);
    return names;
}

const Isa& chooseKernel(std::string_view name) {
    if (name == "auto") return bestIsa();
    std::vector<std::string> supported;
    for (const Isa& isa : allIsas()) {
        if (!isa.supported()) continue;
        if (name == isa.name) return isa;
        supported.emplace_back(isa.name);
    }
    for (const Isa& isa : allIsas())
        if (name == isa.name)
            fail(ErrorKind::Usage, cat("raytracer: error: this CPU can't run the kernel '", name,
                                       "'; it can run: ", join(supported)));
    fail(ErrorKind::Usage, cat("raytracer: error: no kernel ", unknownName(name, kernelNames())));
}
