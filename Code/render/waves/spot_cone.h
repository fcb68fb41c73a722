// SpotCone::attenuation() of light that goes the other way.
#pragma once

#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

LANES_BEGIN

inline Floats coneAt(const SpotCone& cone, const Three& toLight) {
    const Floats zero(0.0f), one(1.0f), edge(cone.cosHalfAngle);
    const Floats c = zero - dot(Three::all(cone.axis.x, cone.axis.y, cone.axis.z), toLight);
    const float soft = (1 - cone.cosHalfAngle) * cone.blend;
    const Floats x = soft > 0 ? min((c - edge) / Floats(soft), one) : one;
    const Floats smooth = x * x * (Floats(3.0f) - Floats(2.0f) * x);
    return select(c <= edge, zero, cone.cosineFalloff ? smooth * max(c, zero) : smooth);
}

LANES_END
