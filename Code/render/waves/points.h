// Stage of the wave: hits -> points. Every surface that a ray has met is described once, and gets
// its material's numbers with the textures applied.
#pragma once

#include "render/waves/steps.h"
#include "render/waves/wave.h"

namespace waves {

// Thousands of shapes are more than the nearest caches hold.
inline void prefetch(const StillShape& shape) {
    const auto* const bytes = reinterpret_cast<const char*>(&shape);
    for (std::size_t at = 0; at < sizeof(shape); at += 64) __builtin_prefetch(bytes + at);
}

// Puts points that lanes do into lists by kind, the others into one of their own.
inline void sortPoints(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const std::vector<Hit>& hits = wave.memory.hits;
    const PointBatch& points = wave.memory.points;
    for (PointsToDescribe& list : wave.memory.onRound) list.clear();
    wave.memory.onOthers.clear();
    const bool hasLanes = !context.roundShapes.empty();
    for (std::uint32_t k = 0; k < points.count; ++k) {
        const std::uint32_t ray = points.ray[k];
        const RoundShape round = hasLanes ? context.roundShapes[hits[ray].shape] : RoundShape{};
        if (round.shape == nullptr || (round.parts >> hits[ray].prim & 1) == 0) {
            wave.memory.onOthers.push(ray, k);
            continue;
        }
        prefetch(*round.shape);
        PointsToDescribe& list = wave.memory.onRound[static_cast<std::size_t>(round.kind)];
        list.push(ray, k);
        list.shapes.push_back(round.shape);
    }
}

// All that are on round shapes together, the others by runs on one shape: what is left when the
// spheres in front of a floor are taken out is long runs on the floor.
inline void findSurfaces(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const std::vector<Hit>& hits = wave.memory.hits;
    PointBatch& points = wave.memory.points;
    if (points.count == 0) return;
    sortPoints(wave);
    const Strided out{&points.at[0].surface, sizeof(ShadedPoint)};
    for (const PointsToDescribe& list : wave.memory.onRound)
        if (!list.rays.empty())
            context.surfaceLanes.round(
                {wave.rays.span(), hits, list.rays, list.points, list.shapes}, out);
    const std::span<const std::uint32_t> rays = wave.memory.onOthers.rays,
                                         to = wave.memory.onOthers.points;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < rays.size(); begin = end) {
        const std::uint32_t shape = hits[rays[begin]].shape;
        for (end = begin + 1; end < rays.size() && hits[rays[end]].shape == shape;) ++end;
        context.scene.shapes().shapes[shape]->surfaces(
            {wave.rays.span(), hits, rays.subspan(begin, end - begin),
             to.subspan(begin, end - begin), context.surfaceNeeds, context.surfaceLanes},
            out);
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
    if constexpr (kTextures) wave.memory.texturedPoints.clear();
    for (std::size_t k = 0; k < points.count; ++k) {
        const std::uint32_t i = points.ray[k];
        ShadedPoint& at = points.at[k];
        shadeSurface<kTextures>(context.scene, wave.rays.ray(i), hits[i], at);
        points.weight[k] = wave.rays.weight[i];
        points.material[k] = &at.of->base;
        if constexpr (kTextures)
            if (at.of->isTextured()) {
                wave.memory.texturedPoints.add(*at.of, static_cast<std::uint32_t>(k));
                points.material[k] = &points.textured[k];
            }
        if (wave.depth == 0 && context.wantsFirstHits)
            wave.chunk.first[wave.rays.sample[i]] =
                describeFirstHit(context.scene, wave.rays.ray(i), at);
    }
    if constexpr (kTextures)
        wave.memory.texturedPoints.apply(context.textureColors, points.at, points.textured);
    if constexpr (kSeeThrough)
        for (std::size_t k = 0; k < points.count; ++k)
            if (points.material[k]->opacity < 1)
                points.weight[k] = points.weight[k] * points.material[k]->opacity;
}
