// Elementary functions in binary128 (113 bits), by series and Newton's method: the truth for those
// of base/math.h. Slow, and right to about 2^-108 of the value, which is 2^-55 of a double's last
// place. Shares nothing with base/math.h; the C library's functions only give first guesses.
#pragma once

namespace binary128 {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128; // of libgcc, also with clang++
#else
using Quad = long double; // 64-bit Arm: is binary128
#endif

Quad sin(double x); // |x| < 2^47
Quad cos(double x);
Quad tan(double x);
Quad asin(double x); // |x| <= 1
Quad acos(double x);
Quad atan2(double y, double x); // finite, not both 0
Quad exp(double x);             // any result up to 2^1100, and from 2^-1100
Quad exp2(double x);
Quad log(double x); // positive and finite
Quad log2(double x);
Quad pow(double x, double y); // x positive
Quad cbrt(double x);

// |value - truth| in units of the last place of a double at the truth; a truth that rounds to
// infinity wants just that. NaN for a value that is none.
double ulpsOff(double value, Quad truth);

} // namespace binary128
