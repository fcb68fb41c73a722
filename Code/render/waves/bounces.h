// Stage of the wave: the rays of the next one, in the order of the points that spawn them: straight
// on through what is not opaque, then reflected, then refracted.
#pragma once

#include "render/waves/bounce_blocks.h"
#include "render/waves/steps.h"

template <bool kBounces, bool kSeeThrough> void spawnBounces(const Wave& wave) {
    wave.memory.next.clear();
    if (wave.depth >= wave.context.settings.picture.maxDepth) return;
    const PointBatch& points = wave.memory.points;
    const bool hasLanes = wave.context.bouncesInLanes != nullptr;
    waves::BouncesInLanes lanes(wave);
    for (std::size_t k = 0; k < points.count; ++k) {
        if constexpr (kBounces && !kSeeThrough)
            if (const std::size_t b = k / PointColumns::kPoints;
                k % PointColumns::kPoints == 0 && wave.context.shadeLanes.mirror != nullptr)
                if (const auto mirrors = waves::plainMirrors(wave, b)) {
                    lanes.send();
                    waves::mirrorInLanes(wave, b, *mirrors);
                    k += points.sizeOf(b) - 1;
                    continue;
                }
        const Material& material = *points.material[k];
        if (points.at.of(k).isLamp) continue;
        if constexpr (kSeeThrough) {
            if (material.opacity < 1) lanes.send();
            waves::goStraight(wave, k);
            if (isBlack(points.weight[k])) continue;
        }
        if constexpr (kBounces)
            if (!isBlack(material.mirror) || !isBlack(material.transmission)) {
                if (hasLanes && (isPlainMirror(material) || isSharpGlass(material))) {
                    lanes.add(k);
                } else {
                    lanes.send();
                    waves::bounceAlone(wave, k);
                }
            }
    }
    lanes.send();
}
