// The half vectors that rough surfaces reflect about: microNormal() of material/material.cpp and
// cosinePowerFromSquare(), operation by operation but for the circle.
#pragma once

#include "simd/pow_of_doubles.h"
#include "simd/vectors3.h"
#include "base/vec.h"
#include "render/waves/bounce_lanes.h"
#include "render/waves/circle_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/frame_lanes.h"
#include "render/waves/fresnel_lanes.h"
#include "sample/sobol.h"
#include "sample/warp.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// Random numbers of W points in u and v, which are of 24 bits, and local directions from them.
struct FacetRow : SquareRow {
    alignas(64) float exponent[W], z[W];
};

inline void drawPairs(const BouncePairs& pairs, std::size_t first, FacetRow& row) {
    for (std::size_t i = 0; i < W; i += kSobolLanes) {
        const auto of = [&](const std::uint32_t* column) {
            return loadBits<kSobolInRow>(column + first + i);
        };
        const auto pair =
            sobolPair<Bits>(of(pairs.sample), of(pairs.index), of(pairs.x), of(pairs.y));
        storeUnit<kSobolInRow>(pair.x, row.u + i), storeUnit<kSobolInRow>(pair.y, row.v + i);
    }
}

inline void placeInLobe(FacetRow& row, unsigned lanes) {
    const Doubles zero(0.0), one(1.0);
    const Doubles power = one / (Doubles(Floats::load(row.exponent)) + one);
    const Doubles cosine = powOfDoubles(Floats(1.0f) - Floats::load(row.u), power);
    const Doubles sine = sqrt(max((one - cosine) * (one + cosine), zero));
    unsigned unsure = 0;
    const OnCircle at = nearlyOnCircle(Floats::load(row.v), unsure);
    surelyRounded(sine * at.x, unsure).store(row.x);
    surelyRounded(sine * at.y, unsure).store(row.y);
    cosine.toFloats().store(row.z);
    for (unsigned rest = lanes & unsure; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const Vec3 way = cosinePowerFromSquare(Vec2{row.u[i], row.v[i]}, row.exponent[i]);
        row.x[i] = way.x, row.y[i] = way.y;
    }
}

// About n, in what the rows have placed.
inline Floats3 halfVectors(const FacetRow& row, const Floats3& n) {
    return normalize(
        framesAround(n).toWorld(Floats::load(row.x), Floats::load(row.y), Floats::load(row.z)));
}

LANES_END
