#include "integrate/context.h"

#include "base/for_each.h"
#include "integrate/camera_medium.h"
#include "scene/frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

SamplerKind samplerKind(SettingsDesc::Sampler kind) {
    switch (kind) {
    case SettingsDesc::Sampler::Stratified: return SamplerKind::Stratified;
    case SettingsDesc::Sampler::Random: return SamplerKind::Random;
    case SettingsDesc::Sampler::ZSobol: return SamplerKind::ZSobol;
    case SettingsDesc::Sampler::Grid:
    case SettingsDesc::Sampler::Corners: return SamplerKind::Grid;
    case SettingsDesc::Sampler::Sobol: break;
    }
    return SamplerKind::Sobol;
}

bool needsFirstHits(const RenderSettings& settings) {
    return !settings.aovs.empty() || (settings.picture.integrator != IntegratorKind::Whitted &&
                                      settings.picture.integrator != IntegratorKind::Path &&
                                      settings.picture.integrator != IntegratorKind::Ao);
}

// Pictures and the integrator that shows them need texture coordinates, shadow rays need lifts.
SurfaceNeeds surfaceNeedsOf(const Scene& scene, const RenderSettings& settings) {
    if (!settings.specialise) return {};
    return {.uv = scene.anyMaterial().pictures || settings.picture.integrator == IntegratorKind::Uv,
            .lift = !scene.pathLights().isEmpty()};
}

StillsInLanes stillsInLanesOf(const Scene& scene, const RenderSettings& settings,
                              SurfaceLanes lanes) {
    StillsInLanes stills;
    if (lanes.stills == nullptr || !settings.specialise) return stills;
    const ShapeSet& set = scene.shapes();
    const auto wantsUv = [&](std::uint32_t number) {
        if (settings.picture.integrator == IntegratorKind::Uv) return true;
        return scene.materials()[number].wantsUv();
    };
    stills.shapes.resize(set.shapes.size());
    const auto take = [&](std::size_t i) {
        if (const StillShape* const shape = set.shapes[i]->stillToShade()) {
            const bool uv = wantsUv(shape->material) || wantsUv(shape->oddMaterial);
            stills.shapes[i] = {shape, shape->parts, shape->caps, shape->kind, uv};
        }
    };
    constexpr std::size_t kTogether = 1 << 12;
    forEachPart(settings.threads, set.shapes.size(), kTogether,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i) take(i);
                });
    return stills;
}

// Returns how many samples share a pixel: the more, the less each has to be the mean of. Where errors decide
// there are as many as are needed, and what filters leave out has to be below any goal.
float samplesTogether(const RenderSettings& settings) {
    constexpr int kWhenRefined = 256;
    const int samples = settings.picture.samplesPerPixel;
    const auto& refinement = settings.refinement;
    if (!refinement) return static_cast<float>(samples);
    return static_cast<float>(refinement->evenDoublings > 0 ? refinement->mostSamples
                                                            : std::max(samples, kWhenRefined));
}
float footprintScaleOf(const Scene& scene, const RenderSettings& settings, bool hasCheckers) {
    constexpr float kOfPixel = 1.0f;
    const bool isWanted = settings.picture.textureFilter == SettingsDesc::TextureFilter::Mip &&
                          (scene.anyMaterial().pictures || hasCheckers);
    return isWanted ? kOfPixel / std::sqrt(samplesTogether(settings)) : 0;
}

bool mayRaysMeetLight(const Scene& scene) {
    return scene.pathLights().hasUnshaped() || scene.environment() != nullptr ||
           !isBlack(scene.background(Rgb{1, 1, 1})) ||
           (scene.lobedMaterials().flagsOfAll() & LobedMaterial::kEmits) != 0;
}

} // namespace

IntegratorContext::IntegratorContext(const Scene& theScene, const RenderSettings& theSettings)
    : scene(theScene), settings(theSettings),
      sampler(samplerKind(theSettings.picture.sampler), theSettings.picture.samplesPerPixel,
              theSettings.picture.seed, theSettings.picture.jitter),
      cutoff(toFloat(theSettings.picture.cutoff)), wantsFirstHits(needsFirstHits(theSettings)),
      raysMeetLight(!theSettings.specialise || mayRaysMeetLight(theScene)),
      surfaceNeeds(surfaceNeedsOf(theScene, theSettings)),
      surfaceLanes(lanesOf(theSettings.isa->surfaces)), pictures(*theSettings.isa->pictures),
      checkers(theSettings.picture.textureFilter == SettingsDesc::TextureFilter::Mip
                   ? checkersOf(theScene)
                   : std::vector<Checker>()),
      footprintScale(footprintScaleOf(theScene, theSettings, !checkers.empty())),
      inverseSamples(1 / samplesTogether(theSettings)),
      stillsInLanes(stillsInLanesOf(theScene, theSettings, surfaceLanes)),
      skySampler(sampler.stream(0, theSettings.picture.lightSamples)),
      cameraMedium(mediumOfCamera(theScene, theSettings, media)) {
    const int samples = settings.picture.lightSamples;
    for (std::size_t i = 0; i < scene.pathLights().size(); ++i)
        lampSamplers.push_back(sampler.stream(static_cast<std::uint32_t>(i) + 1, samples));
}
