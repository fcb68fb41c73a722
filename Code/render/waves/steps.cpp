#include "render/waves/steps.h"

Steps stepsFor(const Scene& scene, const RenderSettings& settings) {
    if (!settings.specialise) return {true, true, true, true, true, true, true};
    Steps steps;
    for (const auto& light : scene.lights())
        steps.softLamps |= light->isSoft() && settings.switches.softShadows;
    steps.draws = steps.softLamps;
    for (const SceneMaterial& m : scene.materials()) {
        steps.lampBodies |= m.isLamp;
        steps.bounces |= !isBlack(m.base.mirror) || !isBlack(m.base.transmission);
        steps.textures |= m.isTextured() || m.bendsNormals();
        steps.draws |= m.base.roughness > 0;
        steps.seeThrough |= m.seeThrough();
        steps.branches |= m.seeThrough() || !isPlainMirror(m.base);
    }
    return steps;
}
