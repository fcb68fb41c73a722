// Stage of the wave: hits -> points. Every surface that a ray has met is described once, and gets
// its material's numbers with the textures applied.
#pragma once

#include "render/waves/steps.h"
#include "render/waves/wave.h"

template <Steps kSteps> void findPoints(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const std::vector<Hit>& hits = wave.memory.hits;
    PointBatch& points = wave.memory.points;
    points.clear(wave.rays.size());
    for (std::size_t i = 0; i < wave.rays.size(); ++i) {
        if (!hits[i].isHit()) continue;
        const std::size_t k = points.count++;
        ShadedPoint& at = points.at[k];
        shade(context.scene, wave.rays.ray(i), hits[i], context.surfaceNeeds, at);
        points.ray[k] = static_cast<std::uint32_t>(i);
        points.weight[k] = wave.rays.weight[i];
        points.material[k] = &at.of->base;
        if constexpr (kSteps.textures)
            if (at.of->isTextured()) {
                points.textured[k] = materialAt(at);
                points.material[k] = &points.textured[k];
            }
        if constexpr (kSteps.seeThrough)
            if (points.material[k]->opacity < 1)
                points.weight[k] = points.weight[k] * points.material[k]->opacity;
        if (wave.depth == 0 && context.wantsFirstHits)
            wave.chunk.first[wave.rays.sample[i]] =
                describeFirstHit(context.scene, wave.rays.ray(i), at);
    }
}
