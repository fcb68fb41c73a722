// The logarithm in the closed forms of lamps with a radius, for one number or for lanes.
#pragma once

#include "simd/region.h"

LANES_BEGIN

// ln(1 + x) / x for x in [0,1], to 2e-7: 2 atanh(z) with z = x / (2 + x).
template <class Number> Number logRatio(Number x) {
    const Number below = Number(2.0f) + x, z = x / below, z2 = z * z;
    Number sum(1.0f / 13);
    for (const float odd : {11.0f, 9.0f, 7.0f, 5.0f, 3.0f, 1.0f}) sum = sum * z2 + Number(1 / odd);
    return Number(2.0f) / below * sum;
}

LANES_END
