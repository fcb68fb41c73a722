// Directions at one lane that only tests draw.
#pragma once

#include "base/vec.h"
#include "material/highlight.h"
#include "sample/warps.h"

inline Vec3 coneFromSquare(Vec2 u, float oneMinusCos) {
    const auto v = kernels::one::coneFromSquare(u.x, u.y, oneMinusCos);
    return {v.x.v, v.y.v, v.z.v};
}
inline Vec3 sphereFromSquare(Vec2 u) { return coneFromSquare(u, 2); }
inline Vec3 cosinePowerFromSquare(Vec2 u, float exponent) {
    const auto v = kernels::one::cosinePowerFromSquare(u.x, u.y, exponent);
    return {v.x.v, v.y.v, v.z.v};
}
