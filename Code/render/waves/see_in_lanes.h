// Stage of the wave: how points are seen: the way to the eye, the side, and the normal on that
// side. The formulas of shadeSurface(), for normals that no picture bends.
#pragma once

#include "render/point_block.h"
#include "render/waves/point_lanes.h"

#include <cstddef>

LANES_BEGIN

inline Floats3 shadingNormal(const PointBlock& block, std::size_t first, const Floats3& ng) {
    const unsigned curved = block.curved >> first & kEvery;
    return curved == 0 ? ng : select(maskOf(curved), load(block.ns, first), ng);
}

unsigned seePoints(PointBlock& block, const Vec3* dirs, unsigned used, unsigned litOutside) {
    unsigned facingAway = 0;
    block.front = block.litApart = 0;
    for (std::size_t first = 0; first < SurfaceBlock::kPoints && used >> first != 0; first += W) {
        const Floats zero(0.0f);
        const Floats3 toEye = negated(normalize(loadRow(dirs, first)));
        const Floats3 ng = load(block.ng, first), ns = shadingNormal(block, first, ng);
        const unsigned lanes = used >> first & kEvery;
        const unsigned front = bits(dot(toEye, ng) >= zero) & lanes;
        block.front |= front << first;
        const Floats3 n = front == lanes ? ns : select(maskOf(front), ns, negated(ns));
        facingAway |= (bits(notGreater(dot(n, toEye), zero)) & lanes) << first;
        store(toEye, block.toEye, first), store(n, block.n, first);

        const unsigned apart = litOutside >> first & lanes & ~front;
        if (apart == 0) continue;
        block.litApart |= apart << first;
        store(ns, block.litN, first);
        if ((block.curved >> first & apart) != 0) { // the lift was for the side of the eye
            const Floats3 none{zero, zero, zero};
            store(select(maskOf(apart), none, load(block.lift, first)), block.lift, first);
        }
    }
    return facingAway;
}

LANES_END
