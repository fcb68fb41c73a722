// Stage of the wave: hits -> points. Every surface that a ray has met is described once, and gets
// its material's numbers with the textures applied.
#pragma once

#include "render/waves/steps.h"
#include "render/waves/wave.h"

namespace waves {

// Thousands of spheres are more than the nearest caches hold.
inline void prefetch(const SphereToShade& sphere) {
    const auto* const bytes = reinterpret_cast<const char*>(&sphere);
    for (std::size_t at = 0; at < sizeof(sphere); at += 64) __builtin_prefetch(bytes + at);
}

// All that are on spheres together, the others by runs on one shape: what is left when the spheres
// in front of a floor are taken out is long runs on the floor.
inline void findSurfaces(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    const std::vector<Hit>& hits = wave.memory.hits;
    PointBatch& points = wave.memory.points;
    PointsToDescribe &onSpheres = wave.memory.onSpheres, &others = wave.memory.onOthers;
    onSpheres.clear(), others.clear();
    std::vector<const SphereToShade*>& spheres = wave.memory.spheres;
    spheres.clear();
    const auto& shapes = context.scene.shapes().shapes;
    const bool takesSpheres = !context.spheres.empty();
    for (std::uint32_t k = 0; k < points.count; ++k) {
        const std::uint32_t ray = points.ray[k];
        const SphereToShade* const sphere =
            takesSpheres ? context.spheres[hits[ray].shape] : nullptr;
        (sphere ? onSpheres : others).push(ray, k);
        if (sphere) {
            prefetch(*sphere);
            spheres.push_back(sphere);
        }
    }
    if (points.count == 0) return;
    const Strided out{&points.at[0].surface, sizeof(ShadedPoint)};
    if (!spheres.empty())
        context.surfaceLanes.spheres(
            {wave.rays.span(), hits, onSpheres.rays, onSpheres.points, spheres}, out);
    const std::vector<std::uint32_t>& rays = others.rays;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < rays.size(); begin = end) {
        const std::uint32_t shape = hits[rays[begin]].shape;
        for (end = begin + 1; end < rays.size() && hits[rays[end]].shape == shape;) ++end;
        shapes[shape]->surfaces({wave.rays.span(), hits,
                                 std::span(rays).subspan(begin, end - begin),
                                 std::span(others.points).subspan(begin, end - begin),
                                 context.surfaceNeeds, context.surfaceLanes},
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
