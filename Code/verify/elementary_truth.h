// Elementary functions in binary128 (113 bits), by series and Newton's method: the truth for those
// of base/math.h. Slow, and right to about 2^-108 of the value, which is 2^-55 of a double's last
// place. Shares nothing with base/math.h; the C library's functions only give first guesses.
#pragma once

#include "verify/binary128.h"

namespace truth {

using battery::Wide;

Wide sin(double x); // |x| < 2^47
Wide cos(double x);
Wide tan(double x);
Wide asin(double x); // |x| <= 1
Wide acos(double x);
Wide atan2(double y, double x); // finite, not both 0
Wide exp(double x);             // any result up to 2^1100, and from 2^-1100
Wide exp2(double x);
Wide log(double x); // positive and finite
Wide log2(double x);
Wide pow(double x, double y); // x positive
Wide cbrt(double x);

// |value - truth| in units of the last place of a double at the truth; a truth that rounds to
// infinity wants just that. NaN for a value that is none.
double ulpsOff(double value, Wide truth);

} // namespace truth
