// Highlights by powers of a cosine.
#pragma once

#include "material/boundary.h"
#include "simd/pow_lanes.h"

LANES_BEGIN

// base^exponent where it holds, else 0.
inline Floats powerWhere(Mask is, Floats base, Floats exponent) {
    const unsigned lanes = bits(is);
    if (lanes == 0) return Floats(0.0f);
    return select(is, powOf(select(is, base, Floats(1.0f)), exponent, lanes), Floats(0.0f));
}

// The half vector of two directions in front of the surface.
struct HalfVector {
    Floats cosNormal, cosEye; // its cosines to the normal, and to either direction
    Mask is;

    HalfVector(const Floats3& toEye, const Floats3& toLight) {
        const Floats3 sum = toEye + toLight;
        const Floats length2 = dot(sum, sum), length = sqrt(length2), zero(0.0f);
        cosNormal = min(sum.z / length, Floats(1.0f));
        is = (toLight.z > zero) & (length2 > Floats(1e-30f)) & (cosNormal > zero);
        // Half the length of v + l is h.v and h.l.
        cosEye = select(is, Floats(0.5f) * length, Floats(1.0f));
    }
    Floats power(Floats exponent) const { return powerWhere(is, cosNormal, exponent); }
};

// What (n.h)^exponent sums up to over the hemisphere at normal incidence.
inline Floats halfVectorSum(Floats exponent) {
    const Floats more = exponent + Floats(2.0f), half(0.5f);
    const Floats rest = powOf(half, more * half, (1u << W) - 1);
    return Floats(static_cast<float>(8 * kPi)) / more * (Floats(1.0f) - rest);
}

// Returns a direction about +z with density (exponent + 1) / (2 pi) cos^exponent.
inline Floats3 cosinePowerFromSquare(Floats u, Floats v, Floats exponent) {
    // In double, as 1 - cos^2 of narrow lobes is small.
    const Doubles power = logOf(Floats(1.0f) - u) / (Doubles(exponent) + Doubles(1.0));
    const Doubles least(-50.0), cosine = expOf(max(power, least), Doubles(0.0));
    const Doubles sine2 = Doubles(1.0) - cosine * cosine;
    const Floats sine = sqrt(max(sine2, Doubles(0.0))).toFloats();
    const SineCosine turn = sinCosOfTurns(v);
    return {sine * turn.cos, sine * turn.sin, cosine.toFloats()};
}

LANES_END
