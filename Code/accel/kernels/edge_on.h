// Which rays may see a triangle edge-on, TrianglePlane::isEdgeOn(): a direction is at most sqrt(3)
// dz long, and the bound is 2^-10 larger than it has to be. Squares in double, which floats of any
// size neither overflow nor underflow, and no root.
#pragma once

#include "accel/triangle.h"
#include "simd/lanes.h"

LANES_BEGIN

// For triangles with these normals.
[[gnu::always_inline]] inline Doubles edgeOnBound(const Doubles& nx, const Doubles& ny,
                                                  const Doubles& nz) {
    constexpr double kPerSteep = 1.7338 / TrianglePlane::kSteep;
    return ((nx * nx + ny * ny) + nz * nz) * Doubles(kPerSteep * kPerSteep);
}
// Also where there is a NaN.
[[gnu::always_inline]] inline unsigned edgeOnLanes(const Doubles& along, const Doubles& bound,
                                                   Floats dz) {
    const Doubles depth(dz);
    return ~less(bound * (depth * depth), along * along);
}

LANES_END
