#include "render/integrator.h"

#include "base/for_each.h"
#include "render/camera_medium.h"
#include "render/to_float.h"
#include "render/waves/steps.h"

#include <algorithm>
#include <utility>

namespace {

SamplerKind samplerKind(SettingsDesc::Sampler kind) {
    switch (kind) {
    case SettingsDesc::Sampler::Stratified: return SamplerKind::Stratified;
    case SettingsDesc::Sampler::Random: return SamplerKind::Random;
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

// Texture coordinates are for pictures, and for who looks at them; lifts are for shadow rays.
SurfaceNeeds surfaceNeedsOf(const Scene& scene, const RenderSettings& settings) {
    if (!settings.specialise) return {};
    return {.uv = stepsFor(scene, settings).textures ||
                  settings.picture.integrator == IntegratorKind::Uv,
            .lift = !scene.lights().empty()};
}

StillsInLanes stillsInLanesOf(const Scene& scene, const RenderSettings& settings,
                              SurfaceLanes lanes) {
    StillsInLanes stills;
    if (lanes.stills == nullptr || !settings.specialise) return stills;
    const ShapeSet& set = scene.shapes();
    const auto wantsUv = [&](std::uint32_t number) {
        if (settings.picture.integrator == IntegratorKind::Uv) return true;
        if (!scene.anyMaterial().pictures) return false;
        const SceneMaterial& material = scene.materials()[number];
        return material.isTextured() || material.bendsNormals() ||
               (scene.isLobed() && scene.lobedMaterials()[number].factors != 0);
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

// The closed forms of lamps that lanes don't do take longer than a few samples.
constexpr int kFewestForWhole = 4;

// Where so many samples are asked for that maps pay, and waves sum up lamps that have some
// (waves/lamp_sums.h).
void mapLamps(const Scene& scene, const RenderSettings& settings, std::vector<Lamp>& lamps) {
    constexpr double kFewestSamples = 16; // for each solid
    const SettingsDesc& picture = settings.picture;
    const double samples =
        static_cast<double>(picture.width) * picture.height * picture.samplesPerPixel;
    const AskLampMapFn ask = lanesOf(settings.isa->lamps).askMap;
    const auto isInLanes = [](const Lamp& lamp) { return lamp.inLanes != nullptr; };
    if (samples < kFewestSamples * static_cast<double>(scene.shapes().solids().solids.size()) ||
        ask == nullptr || scene.hasSeeThrough() ||
        !std::all_of(lamps.begin(), lamps.end(), isInLanes))
        return;
    auto shapes = MappedShapes::of(scene.shapes());
    if (!shapes) return;
    const auto shared = std::make_shared<const MappedShapes>(std::move(*shapes));
    forEachOn(settings.threads, lamps.size(), [&](std::size_t i) {
        lamps[i].map = makeLampMap(shared, *lamps[i].origin);
        lamps[i].askMap = ask;
    });
}

} // namespace

IntegratorContext::IntegratorContext(const Scene& theScene, const RenderSettings& theSettings)
    : scene(theScene), settings(theSettings),
      sampler(samplerKind(theSettings.picture.sampler), theSettings.picture.samplesPerPixel,
              theSettings.picture.seed, theSettings.picture.jitter),
      occluders(theScene.shapes()), cutoff(toFloat(theSettings.picture.cutoff)),
      steps(stepsFor(theScene, theSettings)), wantsFirstHits(needsFirstHits(theSettings)),
      surfaceNeeds(surfaceNeedsOf(theScene, theSettings)),
      surfaceLanes(lanesOf(theSettings.isa->surfaces)), shadeLanes(lanesOf(theSettings.isa->shade)),
      textureColors(lanesOf(theSettings.isa->pictures).texture),
      environmentColors(lanesOf(theSettings.isa->pictures).environment),
      bounceLanes(lanesOf(theSettings.isa->bounce)),
      pairSeeds(sampler.kind() == SamplerKind::Sobol ? lanesOf(theSettings.isa->camera).seeds
                                                     : nullptr),
      stillsInLanes(stillsInLanesOf(theScene, theSettings, surfaceLanes)),
      skySampler(sampler.stream(0, theSettings.picture.lightSamples)),
      materials(theScene, theSettings.threads),
      cameraMedium(mediumOfCamera(theScene, theSettings, media)) {
    const int samples = settings.picture.lightSamples;
    for (std::size_t i = 0; i < scene.lights().size(); ++i) {
        const Light& light = *scene.lights()[i];
        if (light.isDark()) continue;
        const bool isSoft = light.isSoft() && settings.switches.softShadows;
        const bool shades = light.castsShadows() && settings.switches.shadows;
        Lamp lamp{light,
                  isSoft,
                  isSoft ? samples : 1,
                  sampler.stream(static_cast<std::uint32_t>(i) + 1, samples),
                  isSoft ? std::optional<Vec3>() : light.origin(),
                  light.emission(),
                  light.lampEmission(!isSoft)};
        const LampLanes lanes = lanesOf(settings.isa->lamps);
        if (!isSoft && lamp.emission) lamp.inLanes = lanes.byLamp;
        if (lamp.all && (!isSoft || sampler.kind() == SamplerKind::Sobol)) {
            lamp.bySamples = lanes.bySamples, lamp.seeds = lanesOf(settings.isa->camera).seeds;
            if (isSoft && lamp.emission)
                lamp.wholeLight = lanes.wholeLight, lamp.hiddenPoints = lanes.hiddenPoints;
        }
        lamp.asksWhole = isSoft && !shades && (lamp.emission || samples >= kFewestForWhole);
        if (isSoft && lamp.emission && !lamp.emission->cone && occluders.areSolids())
            lamp.ball = lamp.emission->ball();
        (shades ? shadingLamps : openLamps).push_back(lamp);
    }
    for (std::size_t i = 0; i < scene.pathLights().size(); ++i)
        lampSamplers.push_back(sampler.stream(static_cast<std::uint32_t>(i) + 1, samples));
    if (settings.specialise && settings.picture.integrator == IntegratorKind::Whitted)
        mapLamps(scene, settings, shadingLamps);
}
