// Stage of the wave: light that needs no shadow rays, added ray by ray: the background, what
// surfaces emit, ambient light, and lamps that cast no shadows.
#pragma once

#include "render/waves/lamp_light.h"

template <bool kLampBodies, bool kSeeThrough> void addGlow(const Wave& wave) {
    const Scene& scene = wave.context.scene;
    const PathBatch& rays = wave.rays;
    const PointBatch& points = wave.memory.points;
    std::size_t k = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::uint32_t slot = rays.sample[i];
        if (k == points.count || points.ray[k] != i) {
            wave.add(slot, rays.weight[i] * scene.background(rays.dir[i]));
            continue;
        }
        const std::size_t here = k++;
        const Material& material = *points.material[here];
        if constexpr (kLampBodies)
            if (points.at[here].of->isLamp) {
                if (points.at[here].front && rays.seesLights[i])
                    wave.add(slot, rays.weight[i] * material.emission);
                continue;
            }
        const Rgb weight = points.weight[here];
        if constexpr (kSeeThrough)
            if (material.opacity < 1 && isBlack(weight)) continue;
        wave.add(slot, weight * (material.emission + material.diffuse * scene.ambient()));
        if (wave.context.openLamps.empty() || !answersLamps(material)) continue;
        const LitPoint lit = litPoint(wave, here);
        for (const Lamp& lamp : wave.context.openLamps)
            forEachLampSample<true>(wave, lamp, lit,
                                    [&](const LightSample&, Rgb light) { wave.add(slot, light); });
    }
}
