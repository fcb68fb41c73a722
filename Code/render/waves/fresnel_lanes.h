// The formulas of material/fresnel.h for W points, operation by operation.
#pragma once

#include "simd/vectors3.h"
#include "base/vec.h"
#include "render/waves/point_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

inline Floats3 all(Rgb c) { return {Floats(c.r), Floats(c.g), Floats(c.b)}; }
inline unsigned black(const Floats3& a) {
    const Floats zero(0.0f);
    return bits((a.x == zero) & (a.y == zero) & (a.z == zero));
}
inline Floats cos2Refracted(Floats cosIn, Floats eta) {
    const Floats one(1.0f), through = eta * cosIn;
    return (one - eta) * (one + eta) + through * through;
}

inline Floats fresnelDielectric(Floats cosIn, Floats eta) {
    const Floats zero(0.0f), one(1.0f), c = min(max(cosIn, zero), one);
    const Floats cos2Out = cos2Refracted(c, eta), cosOut = sqrt(cos2Out);
    const Floats parallel = (c - eta * cosOut) / (c + eta * cosOut);
    const Floats perpendicular = (eta * c - cosOut) / (eta * c + cosOut);
    const Floats part = Floats(0.5f) * (parallel * parallel + perpendicular * perpendicular);
    return select(cos2Out > zero, part, one);
}

// schlickWeight()
inline Floats schlickRise(Floats cosIn) {
    const Floats m = min(max(Floats(1.0f) - cosIn, Floats(0.0f)), Floats(1.0f));
    return (m * m) * (m * m) * m;
}

LANES_END
