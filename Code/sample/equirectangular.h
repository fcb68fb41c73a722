// Directions as places in an equirectangular picture around the scene, and back.
#pragma once

#include "base/math.h"
#include "sample/sky_place.h"
#include "sample/warps.h"
#include "simd/double_double_lanes.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

LANES_BEGIN

// From the left and the lower edge of a picture, whose sides are 1. s goes round.
struct PicturePlaces {
    Doubles s, t;
};
// Returns the places that directions of any length see; zero counts as +x.
inline PicturePlaces placesOf(const SkyPlace& sky, const Floats3& dir) {
    const Doubles minusZero(-0.0), half(0.5);
    const Doubles x(dir.x), y = sky.isZUp ? Doubles(dir.y) : minusZero - Doubles(dir.z);
    const Doubles z(sky.isZUp ? dir.z : dir.y);
    // asin(z) of a unit vector, without its loss of digits near the poles.
    return {half - anglesOf(y, x) * Doubles(kInvTwoPi) + Doubles(sky.turns),
            half + anglesOf(z, sqrt(x * x + y * y)) * Doubles(kInvPi)};
}

// Returns the direction of length 1 that sees the place s from the left, at the sine z of the
// latitude.
inline Floats3 directionAt(const SkyPlace& sky, const Doubles& s, const Doubles& z) {
    const Doubles one(1.0), turns = Doubles(0.5 + sky.turns) - s;
    const SineCosine at = sinCosOfTurns(min((turns - floor(turns)).toFloats(), Floats(1.0f)));
    const Floats level = sqrt(max((one - z) * (one + z), Doubles(0.0))).toFloats();
    const Floats up = z.toFloats(), x = level * at.cos, y = level * at.sin;
    return normalize(sky.isZUp ? Floats3{x, y, up} : Floats3{x, up, Floats(0.0f) - y});
}

LANES_END
