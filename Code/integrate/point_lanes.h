// Vectors of the points of a block, W points from one of them on.
#pragma once

#include "base/surface_block.h"
#include "integrate/point_block.h"
#include "simd/vectors3.h"

#include <cstddef>

LANES_BEGIN

inline constexpr unsigned kEvery = (1u << W) - 1; // a bit for each lane

using Lane = SurfaceBlock::Lane;

inline Floats3 load(const Lane (&v)[3], std::size_t first) {
    return {Floats::load(v[0] + first), Floats::load(v[1] + first), Floats::load(v[2] + first)};
}
inline void store(const Floats3& v, Lane (&to)[3], std::size_t first) {
    v.x.store(to[0] + first), v.y.store(to[1] + first), v.z.store(to[2] + first);
}
// Sixteen vectors or colours that follow each other.
template <class T> Floats3 loadRow(const T* v, std::size_t first) {
    static_assert(sizeof(T) == 3 * sizeof(float));
    Floats3 out;
    loadVectors(reinterpret_cast<const float*>(v + first), out.x, out.y, out.z);
    return out;
}
template <class T> void storeChosen(unsigned lanes, const Floats3& v, T* to) {
    static_assert(sizeof(T) == 3 * sizeof(float));
    storeChosenVectors(lanes, v.x, v.y, v.z, reinterpret_cast<float*>(to));
}

// Returns the normals of the outside that shading sees.
inline Floats3 shadingNormal(const PointBlock& block, std::size_t first, const Floats3& ng,
                             unsigned bent) {
    const unsigned curved = block.curved >> first & kEvery, changed = bent >> first & kEvery;
    const Floats3 ns = curved == 0 ? ng : select(maskOf(curved), load(block.ns, first), ng);
    return changed == 0 ? ns : select(maskOf(changed), load(block.n, first), ns);
}

// Stage of the wave: how points are seen: the way to the eye, the side, and the normal on that
// side.
unsigned seePoints(PointBlock& block, const Vec3* dirs, unsigned used, unsigned litOutside,
                   unsigned bent) {
    unsigned facingAway = 0;
    block.front = block.litApart = 0;
    for (std::size_t first = 0; first < SurfaceBlock::kPoints && used >> first != 0; first += W) {
        const Floats zero(0.0f);
        const Floats3 toEye = negated(normalize(loadRow(dirs, first)));
        const Floats3 ng = load(block.ng, first), ns = shadingNormal(block, first, ng, bent);
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
