// exact::pow(double, double) of W numbers that are floats from 2^-24 to 1, with exponents from
// 2^-20 to 1: its steps in base/math_powers.cpp, lane by lane and in their order, without those
// that such numbers don't need: they are neither denormal nor longer than a float, and nothing ends
// at zero or infinity.
#pragma once

#include "simd/double_double_lanes.h"
#include "simd/pow_lanes.h"
#include "simd/lanes.h"

LANES_BEGIN

inline DoublePairs longLogOf(Floats x) {
    constexpr double ln2Upper = 0x1.62e42fefa38p-1, ln2Lower = 0x1.ef35793c7673p-45;
    const auto [row, exponent, r, log] = logParts(x); // r is exact
    const DoublePairs square = twoProduct(r, r);
    DoublePairs sum = fastTwoSum(r, square.hi * -0.5);
    sum.lo = sum.lo + (Doubles(0.0) - square.lo * 0.5 + (r * square.hi) * logTail(r));
    Doubles logHi(0.0), logLo(0.0);
    pairsAt<kLogRow>(&exact::kLogTable.front().log.hi, row, logHi, logLo);
    const DoublePairs table = twoSum(exponent * ln2Upper, logHi);
    const DoublePairs total = twoSum(table.hi, sum.hi);
    const Doubles rest = logLo + exponent * ln2Lower;
    return fastTwoSum(total.hi, total.lo + (table.lo + (sum.lo + rest)));
}

inline Doubles powOfDoubles(Floats x, const Doubles& y) {
    const DoublePairs log = longLogOf(x), power = twoProduct(y, log.hi);
    return expOf(power.hi, power.lo + y * log.lo);
}

LANES_END
