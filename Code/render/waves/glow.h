// Stage of the wave: light that needs no shadow rays, added ray by ray: the background, what
// surfaces emit, ambient light, and lamps that cast no shadows.
#pragma once

#include "render/waves/lamp_light.h"

namespace waves {

// Light that comes from the surface itself to where its point is seen.
inline Rgb glowOf(const Scene& scene, const Material& material) {
    return material.emission + material.diffuse * scene.ambient();
}

// Of points that are neither lamps nor looked through.
inline void addGlowOfBlock(const Wave& wave, std::size_t b) {
    const PointBatch& points = wave.memory.points;
    const std::size_t first = b * PointColumns::kPoints, size = points.sizeOf(b);
    if (const Material* const all = points.painted[b]) {
        const Rgb glow = glowOf(wave.context.scene, *all);
        for (std::size_t k = first; k < first + size; ++k)
            wave.add(points.slot[k], points.weight[k] * glow);
        return;
    }
    for (std::size_t k = first; k < first + size; ++k)
        wave.add(points.slot[k],
                 points.weight[k] * glowOf(wave.context.scene, *points.material[k]));
}

inline void addBackground(const Wave& wave, std::size_t ray) {
    const PathBatch& rays = wave.rays;
    wave.add(rays.sample[ray], rays.weight[ray] * wave.context.scene.background(rays.dir[ray]));
}

} // namespace waves

// Where every sample has one ray: nobody asks for an order.
inline void addPlainGlow(const Wave& wave) {
    const PointBatch& points = wave.memory.points;
    for (const std::uint32_t ray : std::span(points.missed).first(points.missedCount))
        waves::addBackground(wave, ray);
    for (std::size_t b = 0; b < points.blocks(); ++b) waves::addGlowOfBlock(wave, b);
}

template <bool kLampBodies, bool kSeeThrough> void addGlow(const Wave& wave) {
    const Scene& scene = wave.context.scene;
    const PathBatch& rays = wave.rays;
    const PointBatch& points = wave.memory.points;
    if constexpr (!kLampBodies && !kSeeThrough)
        if (wave.hasOneRayPerSample() && wave.context.openLamps.empty()) return addPlainGlow(wave);
    std::size_t k = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::uint32_t slot = rays.sample[i];
        if (k == points.count || points.ray[k] != i) {
            waves::addBackground(wave, i);
            continue;
        }
        const std::size_t here = k++;
        const Material& material = *points.material[here];
        if constexpr (kLampBodies)
            if (points.at.of(here).isLamp) {
                if (points.at[here].front && rays.seesLights[i])
                    wave.add(slot, rays.weight[i] * material.emission);
                continue;
            }
        const Rgb weight = points.weight[here];
        if constexpr (kSeeThrough)
            if (material.opacity < 1 && isBlack(weight)) continue;
        wave.add(slot, weight * waves::glowOf(scene, material));
        if (wave.context.openLamps.empty() || !answersLamps(material)) continue;
        const LitPoint lit = litPoint(wave, here);
        for (const Lamp& lamp : wave.context.openLamps)
            forEachLampSample<true>(wave, lamp, lit,
                                    [&](const LightSample&, Rgb light) { wave.add(slot, light); });
    }
}
