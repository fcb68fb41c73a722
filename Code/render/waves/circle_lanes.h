// circlePoint() of sample/warp.cpp, nearly: for who rounds to floats what it makes of them.
#pragma once

#include "simd/vectors3.h"
#include "base/math.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

LANES_BEGIN

// Where the angle 2 pi u is on the unit circle, reckoned to 2^-41 of either number for u of 24
// bits.
// exact::sinCos() gets this angle rounded to a double, and so does who wants the same near zeros.
// Lanes of right angles are added to `unsure`: of their zeros too little is left.
struct OnCircle {
    Doubles x, y;
};
inline OnCircle nearlyOnCircle(Floats u, unsigned& unsure) {
    // A right angle in two parts: four times the first one is exact.
    constexpr double kRight = 0x1.921fb5444p+0, kRest = 0x1.68c234c4c6629p-39;
    const Floats turns = floor(u * Floats(4.0f) + Floats(0.5f));
    const Doubles quarter(turns);
    const Doubles rest =
        (Doubles(kTwoPi) * Doubles(u) - quarter * Doubles(kRight)) - quarter * Doubles(kRest);
    unsure |= bits(abs(rest.toFloats()) < Floats(0x1p-22f));
    const Doubles q = rest * Doubles(4 / kPi), w = q * q, zero(0.0);
    const Doubles c = cosineOf(w), s = q * sineOf(w);
    const auto is = [&](float turn) { return turns == Floats(turn); };
    const Mask second = is(1), third = is(2), fourth = is(3);
    return {select(second, zero - s, select(third, zero - c, select(fourth, s, c))),
            select(second, c, select(third, zero - s, select(fourth, zero - c, s)))};
}

LANES_END
