// Maps from the unit square to disks, spheres, cones and triangles, and frames around a direction,
// for lanes; the one lane is the scalar code. All preserve areas or have the stated density.
#pragma once

#include "base/math.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

LANES_BEGIN

struct Floats2 {
    Floats x, y;
};

struct SineCosine {
    Floats sin, cos;
};
// Returns sine and cosine of the angle (pi/2) r, r from -1/2 to 1/2, to 1.5 ulp (Taylor series, the
// next terms are below 2e-9 and 3e-8 of the sum).
inline SineCosine sinCosOfQuarter(Floats r) {
    const Floats x = r * Floats(static_cast<float>(kHalfPi)), z = x * x;
    const Floats s =
        ((Floats(1.0f / 362880) * z - Floats(1.0f / 5040)) * z + Floats(1.0f / 120)) * z -
        Floats(1.0f / 6);
    const Floats c =
        (((Floats(1.0f / 40320) * z - Floats(1.0f / 720)) * z + Floats(1.0f / 24)) * z -
         Floats(0.5f)) *
        z;
    return {x + (x * z) * s, Floats(1.0f) + c};
}

// Returns sine and cosine of 2 pi u, u in [0,1].
inline SineCosine sinCosOfTurns(Floats u) {
    const Floats four = u * Floats(4.0f), quarter = floor(four + Floats(0.5f));
    const SineCosine near = sinCosOfQuarter(four - quarter); // exact
    const Floats zero(0.0f);
    const Mask odd = (quarter == Floats(1.0f)) | (quarter == Floats(3.0f));
    const Mask sinIsNegative = (quarter == Floats(2.0f)) | (quarter == Floats(3.0f));
    const Mask cosIsNegative = (quarter == Floats(1.0f)) | (quarter == Floats(2.0f));
    const Floats s = select(odd, near.cos, near.sin), c = select(odd, near.sin, near.cos);
    return {select(sinIsNegative, zero - s, s), select(cosIsNegative, zero - c, c)};
}

// Returns the angle of (x, y) with the x axis, for y >= 0: 0 to pi, to 2e-7 of itself (Taylor
// series up to tan(pi/8), the next term is below 2e-8).
inline Floats angleInHalfTurn(Floats y, Floats x) {
    const Floats zero(0.0f), absX = abs(x);
    const Mask isSteep = y > absX;
    const Floats less = select(isSteep, absX, y), more = select(isSteep, y, absX);
    const Mask isMiddle = less > more * Floats(0.41421356f); // beyond pi/8: less pi/4
    const Floats above = select(isMiddle, less - more, less);
    const Floats under = select(isMiddle, less + more, more);
    const Floats t = select(under > zero, above / under, zero), z = t * t;
    Floats sum(1.0f / 17);
    for (float odd = 15; odd > 2; odd -= 2) sum = Floats(1 / odd) - sum * z;
    const Floats inOctant =
        (t - t * z * sum) + select(isMiddle, Floats(static_cast<float>(kPi / 4)), zero);
    const Floats right(static_cast<float>(kHalfPi)), half(static_cast<float>(kPi));
    const Floats toAxis = select(isSteep, right - inOctant, inOctant);
    return select(x < zero, half - toAxis, toAxis);
}

// Returns a place on the unit disk, uniform, concentric (Shirley and Chiu 1997).
inline Floats2 diskFromSquare(Floats u, Floats v) {
    const Floats zero(0.0f), one(1.0f), two(2.0f);
    const Floats x = two * u - one, y = two * v - one;
    const Mask isSide = abs(x) > abs(y);
    const Floats radius = select(isSide, x, y), other = select(isSide, y, x);
    const Floats ratio = select(radius == zero, zero, other / radius);
    const SineCosine at = sinCosOfQuarter(ratio * Floats(0.5f));
    return {radius * select(isSide, at.cos, at.sin), radius * select(isSide, at.sin, at.cos)};
}

// Returns a place on a regular polygon, uniform: u picks the triangle of two neighbouring corners
// and the centre, and the place across it; sqrt(v) is the distance from the centre. `corners`:
// cosine and sine of each, the first one again at the end.
inline Floats2 polygonFromSquare(const double* corners, int blades, Floats u, Floats v) {
    const Doubles at = Doubles(u) * Doubles(blades), blade = floor(at);
    const Doubles across = at - blade, rest = Doubles(1.0) - across, radius = sqrt(Doubles(v));
    const Ints i = wholeOf(blade);
    Doubles x(0.0), y(0.0), nextX(0.0), nextY(0.0);
    pairsAt<2>(corners, i, x, y), pairsAt<2>(corners + 2, i, nextX, nextY);
    return {(radius * (x * rest + nextX * across)).toFloats(),
            (radius * (y * rest + nextY * across)).toFloats()};
}

// Returns a direction about +z with density cos / pi per steradian (Malley).
inline Floats3 cosineHemisphereFromSquare(Floats u, Floats v) {
    const Floats2 d = diskFromSquare(u, v);
    const Floats z2 = Floats(1.0f) - d.x * d.x - d.y * d.y;
    return {d.x, d.y, sqrt(max(z2, Floats(0.0f)))};
}

// Returns a direction in the cone about +z with this 1 - cos of its half angle, with density
// 1 / (2 pi oneMinusCos) per steradian.
inline Floats3 coneFromSquare(Floats u, Floats v, Floats oneMinusCos) {
    const Floats h = oneMinusCos * u, sine = sqrt(max(h * (Floats(2.0f) - h), Floats(0.0f)));
    const SineCosine turn = sinCosOfTurns(v);
    return {sine * turn.cos, sine * turn.sin, Floats(1.0f) - h};
}

// Returns a direction anywhere, with density 1 / (4 pi).
inline Floats3 sphereFromSquare(Floats u, Floats v) { return coneFromSquare(u, v, Floats(2.0f)); }

// Three perpendicular unit vectors, right-handed.
struct ShadingFrame {
    Floats3 x, y, z;
    Floats3 toWorld(const Floats3& v) const { return x * v.x + y * v.y + z * v.z; }
    Floats3 toLocal(const Floats3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};
// Returns a frame with this unit vector as its z (Duff et al. 2017).
inline ShadingFrame frameAroundZ(const Floats3& z) {
    const Floats one(1.0f), sign = withSign(one, z.z);
    const Floats a = Floats(-1.0f) / (sign + z.z), b = z.x * z.y * a;
    return {{one + sign * z.x * z.x * a, sign * b, Floats(0.0f) - sign * z.x},
            {b, sign + z.y * z.y * a, Floats(0.0f) - z.y},
            z};
}

LANES_END
