// Sine and cosine of W angles between 0 and 2 pi, to 2^-46 of 1.
#pragma once

#include "base/math.h"
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

LANES_END
