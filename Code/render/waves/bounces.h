// Stage of the wave: the rays of the next one, in the order of the points that spawn them: straight
// on through what is not opaque, then reflected, then refracted.
#pragma once

#include "render/waves/bounce_blocks.h"
#include "render/waves/mirror_blocks.h"
#include "render/waves/steps.h"

namespace waves {

template <bool kBounces, bool kSeeThrough> void bounceOneByOne(const Wave& wave, std::size_t b) {
    const PointBatch& points = wave.memory.points;
    const std::size_t first = b * PointColumns::kPoints;
    for (std::size_t k = first; k < first + points.sizeOf(b); ++k) {
        const Material& material = *points.material[k];
        if (points.at.of(k).isLamp) continue;
        if constexpr (kSeeThrough) {
            goStraight(wave, k);
            if (isBlack(points.weight[k])) continue;
        }
        if constexpr (kBounces)
            if (!isBlack(material.mirror) || !isBlack(material.transmission)) bounceAlone(wave, k);
    }
}

inline bool isOpaque(const PointBatch& points, std::size_t b) {
    const auto first =
        points.material.begin() + static_cast<std::ptrdiff_t>(b * PointColumns::kPoints);
    return std::all_of(first, first + static_cast<std::ptrdiff_t>(points.sizeOf(b)),
                       [](const Material* material) { return material->opacity >= 1; });
}

} // namespace waves

template <bool kBounces, bool kSeeThrough> void spawnBounces(const Wave& wave) {
    wave.memory.next.clear();
    if (wave.depth >= wave.context.settings.picture.maxDepth) return;
    const PointBatch& points = wave.memory.points;
    const Steps& steps = wave.context.steps;
    const bool areMirrors = wave.context.bounceLanes.bounce && !steps.branches && !steps.draws;
    for (std::size_t b = 0; b < points.blocks(); ++b) {
        if constexpr (kBounces && !kSeeThrough)
            if (areMirrors) {
                waves::mirrorBlock(wave, b);
                continue;
            }
        if constexpr (kBounces)
            if (wave.context.bounceLanes.bounce && (!kSeeThrough || waves::isOpaque(points, b)))
                if (const waves::BouncingBlock block(wave, b); block.areForLanes()) {
                    block.send();
                    continue;
                }
        waves::bounceOneByOne<kBounces, kSeeThrough>(wave, b);
    }
}
