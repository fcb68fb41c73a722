// Stage of the wave: hits -> points. Every surface that a ray has met is described once, and gets
// its material's numbers with the textures applied.
#pragma once

#include "render/waves/steps.h"
#include "render/waves/wave.h"

namespace waves {

// Of points in a row on one shape together.
inline void findSurfaces(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const std::vector<Hit>& hits = wave.memory.hits;
    PointBatch& points = wave.memory.points;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < points.count; begin = end) {
        const std::uint32_t shape = hits[points.ray[begin]].shape;
        for (end = begin + 1; end < points.count && hits[points.ray[end]].shape == shape;) ++end;
        const std::span run(points.ray.data() + begin, end - begin);
        context.scene.shapes().shapes[shape]->surfaces(
            {wave.rays.span(), hits, run, context.surfaceNeeds, context.sphereSurfaces},
            {&points.at[begin].surface, sizeof(ShadedPoint)});
    }
}

} // namespace waves

template <bool kTextures, bool kSeeThrough> void findPoints(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const std::vector<Hit>& hits = wave.memory.hits;
    PointBatch& points = wave.memory.points;
    points.clear(wave.rays.size());
    for (std::uint32_t i = 0; i < wave.rays.size(); ++i) {
        points.ray[points.count] = i;
        points.count += hits[i].isHit();
    }
    waves::findSurfaces(wave);
    for (std::size_t k = 0; k < points.count; ++k) {
        const std::uint32_t i = points.ray[k];
        ShadedPoint& at = points.at[k];
        shadeSurface<kTextures>(context.scene, wave.rays.ray(i), hits[i], at);
        points.weight[k] = wave.rays.weight[i];
        points.material[k] = &at.of->base;
        if constexpr (kTextures)
            if (at.of->isTextured()) {
                points.textured[k] = materialAt(at);
                points.material[k] = &points.textured[k];
            }
        if constexpr (kSeeThrough)
            if (points.material[k]->opacity < 1)
                points.weight[k] = points.weight[k] * points.material[k]->opacity;
        if (wave.depth == 0 && context.wantsFirstHits)
            wave.chunk.first[wave.rays.sample[i]] =
                describeFirstHit(context.scene, wave.rays.ray(i), at);
    }
}
