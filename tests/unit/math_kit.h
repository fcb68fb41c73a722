// What the tests of the elementary functions share. The truth is the C library's long double (64
// bits on x86-64, 113 on Arm), whose own error of one of its units is below 0.001 ulp of a double.
// Against 113 bits, where functions go wrong: T12 of the battery (verify/elementary.cpp).
#pragma once

#include "check.h"

#include <cmath>
#include <ios>
#include <limits>
#include <random>

namespace math_kit {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The gap between doubles at the true value.
inline long double ulpAt(long double truth) {
    const long double size = std::fabs(truth);
    if (size < 0x1p-1022L) return 0x1p-1074L;
    int exponent = 0;
    std::frexp(size, &exponent);
    return std::ldexp(1.0L, exponent - 53);
}

// Checks one function over random arguments from `next`; shows the largest error if it fails.
template <class Function, class Truth, class Next>
void checkUlp(const char* name, double bound, int count, Function function, Truth truth,
              Next next) {
    double worst = 0, worstAt = 0;
    for (int i = 0; i < check::scaled(count); ++i) {
        const double x = next();
        const long double expected = truth(static_cast<long double>(x));
        const double value = function(x);
        const double error = static_cast<double>(
            std::fabs(static_cast<long double>(value) - expected) / ulpAt(expected));
        // NaN is worse than any number, and stays.
        if (worst == worst && !(error <= worst)) worst = error, worstAt = x;
    }
    CHECK_INFO(worst <= bound, name << ": " << worst << " ulp at " << std::hexfloat << worstAt);
}

struct Draw {
    std::mt19937_64 engine{20240611}; // the seed of all tests here
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
    // Evenly spread in the exponent, both signs.
    double spread(double loExponent, double hiExponent) {
        const double size = std::exp2(uniform(loExponent, hiExponent));
        return engine() & 1 ? size : -size;
    }
};

inline constexpr int kCount = 200000;

} // namespace math_kit
