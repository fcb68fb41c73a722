// The exact sums and products of base/double_double.h for W numbers, operation by operation.
#pragma once

#include "simd/lanes.h"

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

LANES_END
