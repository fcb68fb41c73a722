// exact::sin() of W angles that arcs between two keys have, operation by operation as in
// base/math_angles.cpp.
#pragma once

#include "simd/double_double_lanes.h"
#include "base/math.h"
#include "base/rounder.h"
#include "simd/lanes.h"

LANES_BEGIN

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
