#include "render/waves/steps.h"

#include <algorithm>

Steps stepsFor(const Scene& scene, const RenderSettings& settings) {
    if (!settings.specialise) return kCompiledSteps.back();
    Steps steps;
    for (const auto& light : scene.lights())
        steps.softLamps |= light->isSoft() && settings.switches.softShadows;
    for (const SceneMaterial& m : scene.materials()) {
        steps.lampBodies |= m.isLamp;
        steps.bounces |= !isBlack(m.base.mirror) || !isBlack(m.base.transmission);
        steps.textures |= m.isTextured() || m.bendsNormals();
        steps.seeThrough |= m.seeThrough();
    }
    return steps;
}

std::size_t compiledFor(const Steps& need) {
    constexpr Steps kEverything{true, true, true, true, true};
    static_assert(kCompiledSteps.back().cover(kEverything));
    const auto first = std::find_if(kCompiledSteps.begin(), kCompiledSteps.end(),
                                    [&](const Steps& steps) { return steps.cover(need); });
    return static_cast<std::size_t>(first - kCompiledSteps.begin());
}
