#include "render/waves/steps.h"

Steps stepsFor(const Scene& scene, const RenderSettings& settings) {
    if (!settings.specialise) return {true, true, true, true, true, true, true};
    Steps steps;
    for (const auto& light : scene.lights())
        steps.softLamps |= light->isSoft() && settings.switches.softShadows;
    steps.draws = steps.softLamps;
    const AnyMaterial& any = scene.anyMaterial();
    steps.draws |= any.isRough;
    steps.lampBodies = any.isLamp;
    steps.bounces = any.bounces;
    steps.textures = any.pictures;
    steps.seeThrough = any.seeThrough;
    steps.branches = any.branches;
    return steps;
}
