// Stage of the wave: light that needs no shadow rays, added ray by ray: the background, what
// surfaces emit, ambient light, and lamps that cast no shadows unless lanes sum them up (lamps.h).
#pragma once

#include "render/waves/background.h"
#include "render/waves/lamp_sums.h"

#include <array>

namespace waves {

using BlockGlow = std::array<Rgb, PointColumns::kPoints>;

// Of points that are neither lamps nor looked through, where every sample has one of them; `glow`
// keeps what the last block had.
inline void addGlowOfBlock(const Wave& wave, std::size_t b, BlockGlow& glow,
                           const Material*& glowIsOf) {
    const PointBatch& points = wave.memory.points;
    const MaterialTable& materials = wave.context.materials;
    const PaintedBlock& painted = points.painted[b];
    const std::size_t first = b * PointColumns::kPoints, size = points.sizeOf(b);
    const std::uint32_t* const number = points.at.block(b).material;
    if (painted.isTextured)
        for (std::size_t i = 0; i < size; ++i)
            glow[i] = glowOf(*points.material[first + i], wave.context.scene.ambient());
    else if (painted.all == nullptr)
        for (std::size_t i = 0; i < size; ++i) glow[i] = materials.glow(number[i]);
    else if (painted.all != glowIsOf)
        glow.fill(materials.glow(number[0]));
    glowIsOf = painted.all;

    const std::uint32_t* const slot = &points.slot[first];
    const Rgb* const weight = &points.weight[first];
    if (size == glow.size() && slot[size - 1] - slot[0] == size - 1 && // they ascend
        wave.context.shadeLanes.glow != nullptr)
        return wave.context.shadeLanes.glow(weight, glow.data(), &wave.chunk.radiance[slot[0]]);
    for (std::size_t i = 0; i < size; ++i) wave.add(slot[i], weight[i] * glow[i]);
}

} // namespace waves

// Where every sample has one ray: nobody asks for an order.
inline void addPlainGlow(const Wave& wave) {
    const PointBatch& points = wave.memory.points;
    const auto missed = std::span(points.missed).first(points.missedCount);
    const PathBatch& rays = wave.rays;
    if (wave.context.scene.environment() != nullptr) {
        const std::span<const Rgb> seen = waves::backgroundsOf(wave);
        for (std::size_t m = 0; m < missed.size(); ++m)
            wave.add(rays.sample[missed[m]], rays.weight[missed[m]] * seen[m]);
    } else {
        const Rgb background = wave.context.scene.background(Vec3{});
        for (const std::uint32_t ray : missed)
            wave.add(rays.sample[ray], rays.weight[ray] * background);
    }
    waves::BlockGlow glow;
    const Material* glowIsOf = nullptr;
    for (std::size_t b = 0; b < points.blocks(); ++b)
        waves::addGlowOfBlock(wave, b, glow, glowIsOf);
}

template <bool kLampBodies, bool kSeeThrough> void addGlow(const Wave& wave) {
    const Scene& scene = wave.context.scene;
    const PathBatch& rays = wave.rays;
    const PointBatch& points = wave.memory.points;
    if constexpr (!kLampBodies && !kSeeThrough)
        if (wave.hasOneRayPerSample() &&
            (wave.context.openLamps.empty() || waves::sumsOpenLamps(wave)))
            return addPlainGlow(wave);
    const std::span<const Rgb> seen = waves::backgroundsOf(wave);
    const Rgb background = seen.empty() ? scene.background(Vec3{}) : Rgb{};
    std::size_t k = 0, missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::uint32_t slot = rays.sample[i];
        if (k == points.count || points.ray[k] != i) {
            wave.add(slot, rays.weight[i] * (seen.empty() ? background : seen[missed++]));
            continue;
        }
        const std::size_t here = k++;
        const Material& material = *points.material[here];
        if constexpr (kLampBodies)
            if (points.at.of(here).isLamp) {
                if (rays.seesLights[i]) wave.add(slot, rays.weight[i] * material.emission);
                continue;
            }
        const Rgb weight = points.weight[here];
        if constexpr (kSeeThrough)
            if (material.opacity < 1 && isBlack(weight)) continue;
        wave.add(slot, weight * glowOf(material, scene.ambient()));
        if (wave.context.openLamps.empty() || !answersLamps(material)) continue;
        const LitPoint lit = litPoint(wave, here);
        for (const Lamp& lamp : wave.context.openLamps) {
            Rgb sum = lamp.asksWhole ? wholeLight(lamp, lit) : Rgb{};
            if (isBlack(sum))
                forEachLampSample<true>(wave, lamp, lit,
                                        [&](const LightSample&, Rgb light) { sum += light; });
            wave.add(slot, sum);
        }
    }
}
