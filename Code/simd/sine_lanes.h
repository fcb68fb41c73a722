// Sine and cosine of W angles between 0 and 2 pi, to 2^-46 of 1.
#pragma once

#include "base/math.h"
#include "base/rounder.h"
#include "simd/double_double_lanes.h"
#include "simd/lanes.h"

LANES_BEGIN

struct SinesCosines {
    Doubles sin, cos;
};
// Series to x^15 and x^16 of what is left of the nearest multiple of pi/2: the next terms are below
// 2^-54 of 1.
inline SinesCosines sinesCosinesOf(const Doubles& angle) {
    const auto c = [](double number) { return Doubles(number); };
    const Doubles quarter = floor(angle * c(2 / kPi) + c(0.5));
    const Doubles x = angle - quarter * c(kHalfPi), z = x * x;
    Doubles s = c(-1.0 / 1307674368000), t = c(1.0 / 20922789888000);
    for (const double term : {1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880, -1.0 / 5040,
                              1.0 / 120, -1.0 / 6, 1.0})
        s = s * z + c(term);
    for (const double term : {-1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320,
                              -1.0 / 720, 1.0 / 24, -0.5, 1.0})
        t = t * z + c(term);
    s = s * x;
    // Quarters 1 and 3 swap them; 2 and 3 turn the sine, 1 and 2 the cosine.
    const auto is = [&](double number) { return atMost(quarter, c(number)) & atMost(c(number), quarter); };
    const unsigned one = is(1), two = is(2), three = is(3);
    const Mask odd = maskOf(one | three);
    const Doubles sine = select(odd, t, s), cosine = select(odd, s, t);
    return {select(maskOf(two | three), c(0) - sine, sine),
            select(maskOf(one | two), c(0) - cosine, cosine)};
}

// exact::sin() of W angles that arcs between two keys have, operation by operation as in
// base/math_angles.cpp.

// Return the upper parts of what sinKernel() and cosKernel() return.
inline Doubles sineNearZero(const Doubles& x, const Doubles& lo) {
    const auto c = [](double number) { return Doubles(number); };
    const Doubles z = x * x, z2 = z * z, z4 = z2 * z2;
    const Doubles low =
        (c(1.0 / 120) + z * c(-1.0 / 5040)) + z2 * (c(1.0 / 362880) + z * c(-1.0 / 39916800));
    const Doubles high =
        (c(1.0 / 6227020800) + z * c(-1.0 / 1307674368000)) + z2 * c(1.0 / 355687428096000);
    return x + ((x * z) * (c(-1.0 / 6) + z * (low + z4 * high)) + lo * (c(1) - c(0.5) * z));
}
inline Doubles cosineNearZero(const Doubles& x, const Doubles& lo) {
    const auto c = [](double number) { return Doubles(number); };
    const Doubles z = x * x, z2 = z * z, z4 = z2 * z2;
    const Doubles low =
        (c(1.0 / 24) + z * c(-1.0 / 720)) + z2 * (c(1.0 / 40320) + z * c(-1.0 / 3628800));
    const Doubles high =
        (c(1.0 / 479001600) + z * c(-1.0 / 87178291200)) + z2 * c(1.0 / 20922789888000);
    const Doubles half = c(0.5) * z, main = c(1) - half;
    return main + (((c(1) - main) - half) + (z2 * (low + z4 * high) - x * lo));
}

// From 0 to pi/2, and a rounding more: the quadrant is 0 or 1.
inline Doubles sineOfArc(const Doubles& x) {
    const Doubles zero(0.0), minus(-0.0);
    const unsigned all = (1u << W) - 1;
    const unsigned tiny = less(x, Doubles(0x1p-27)), large = all & ~less(x, Doubles(kPi / 4));
    const auto unlessTiny = [&](const Doubles& sine) {
        return tiny == 0 ? sine : select(maskOf(tiny), x, sine);
    };
    if (large == 0) return unlessTiny(sineNearZero(x, zero));

    // reduceSmall()
    const Doubles rounder(kRounder), n = (x * Doubles(2 / kPi) + rounder) - rounder;
    const DoublePairs a =
        twoSum(x - n * Doubles(0x1.921fb544p0), minus - n * Doubles(0x1.0b4611a6p-34));
    const DoublePairs b = twoSum(a.hi, minus - n * Doubles(0x1.3198a2ep-69));
    const Doubles rest = (a.lo + b.lo) - n * Doubles(0x1.b839a252049c1p-104);
    const Doubles hi = b.hi + rest, lo = rest - (hi - b.hi);
    const Mask isReduced = maskOf(large);
    const Doubles angle = select(isReduced, hi, x), tail = select(isReduced, lo, zero);
    const Mask isCosine = maskOf(large & less(Doubles(0.5), n));
    return unlessTiny(select(isCosine, cosineNearZero(angle, tail), sineNearZero(angle, tail)));
}

LANES_END
