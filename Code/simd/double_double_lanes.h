// The exact sums and products of base/double_double.h for W numbers, operation by operation.
#pragma once

#include "base/function_tables.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

#include <limits>

LANES_BEGIN

// DoubleDouble
struct DoublePairs {
    Doubles hi, lo;
};
inline DoublePairs twoSum(const Doubles& a, const Doubles& b) {
    const Doubles sum = a + b, b2 = sum - a;
    return {sum, (a - (sum - b2)) + (b - b2)};
}
inline DoublePairs fastTwoSum(const Doubles& a, const Doubles& b) {
    const Doubles sum = a + b;
    return {sum, b - (sum - a)};
}
inline DoublePairs split(const Doubles& a) {
    const Doubles scaled = a * Doubles(134217729.0), hi = scaled - (scaled - a);
    return {hi, a - hi};
}
inline DoublePairs twoProduct(const Doubles& a, const Doubles& b) {
    const Doubles product = a * b;
    const DoublePairs x = split(a), y = split(b);
    return {product, x.lo * y.lo - (((product - x.hi * y.hi) - x.lo * y.hi) - x.hi * y.lo)};
}

// exact::atan2() of W points, operation by operation as in base/math_angles.cpp, for numbers that
// come from floats or from the square root of two squares of them, or are on a unit circle: none is
// so large or small that products would have to be scaled.

// atanTail()
inline Doubles atanTails(const Doubles& t) {
    const auto c = [](double number) { return Doubles(number); };
    const Doubles z = t * t, z2 = z * z;
    const Doubles low = (c(-1.0 / 3) + z * c(1.0 / 5)) + z2 * (c(-1.0 / 7) + z * c(1.0 / 9));
    const Doubles high = c(-1.0 / 11) + z * (c(1.0 / 13) - z * c(1.0 / 15));
    return (t * z) * (low + (z2 * z2) * high);
}

inline Doubles anglesOf(const Doubles& y, const Doubles& x) {
    const Doubles zero(0.0), one(1.0), minusOne(-1.0);
    const unsigned all = (1u << W) - 1;
    const Doubles absX = abs(x), absY = abs(y), a = min(absX, absY), b = max(absX, absY);

    // atan(a / b), in [0, pi/4]; equal numbers, and none, count as 0 first.
    const Mask isLess = a < b;
    const Doubles ratio = select(isLess, a / b, zero);
    const Ints k = wholeOf(ratio * Doubles(16.0) + Doubles(0.5));
    const Doubles c = doublesOf(k) * Doubles(0.0625);
    // twoProduct(c, b): c has five bits.
    const Doubles product = c * b;
    const DoublePairs parts = split(b);
    const Doubles rest = zero - ((product - c * parts.hi) - c * parts.lo);
    const double* const table = &exact::kAtanTable.front().hi;
    const Mask isSmall = ratio < Doubles(0.0625);
    const Doubles t = select(isSmall, ratio, ((a - product) - rest) / (b + c * a));
    const Doubles tail = atanTails(t);
    Doubles ofK(0.0), restOfK(0.0);
    pairsAt<2>(table, k, ofK, restOfK);
    Doubles hi = select(isSmall, ratio, ofK);
    Doubles lo = select(isSmall, tail, t + (restOfK + tail));
    const unsigned equal = all & ~bits(isLess) & less(zero, b);
    if (equal != 0) {
        const DoubleDouble quarter = exact::kAtanTable[16];
        hi = select(maskOf(equal), Doubles(quarter.hi), hi);
        lo = select(maskOf(equal), Doubles(quarter.lo), lo);
    }

    // The octant.
    const unsigned isSteep = less(absX, absY), isLeft = less(withSign(one, x), zero);
    const DoubleDouble half = exact::kHalfPiDd;
    const auto base = [&](double part) {
        return select(maskOf(isSteep), Doubles(part),
                      select(maskOf(isLeft), Doubles(2 * part), zero));
    };
    const Doubles sign = select(maskOf(isSteep ^ isLeft), minusOne, one);
    const DoublePairs sum = twoSum(base(half.hi), sign * hi);
    const Doubles angle = sum.hi + (sum.lo + (base(half.lo) + (sign * lo + zero)));
    const unsigned numbers = atMost(zero, absX) & atMost(zero, absY);
    const Doubles signedAngle = withSign(angle, y);
    if (numbers == all) return signedAngle;
    return select(maskOf(numbers), signedAngle, Doubles(std::numeric_limits<double>::quiet_NaN()));
}

LANES_END
