// The tables of exact::atan2() and exact::pow(), which their steps in lanes read, too.
#pragma once

#include "base/double_double.h"

#include <array>

namespace exact {

extern const std::array<DoubleDouble, 17> kAtanTable; // atan(k / 16)
inline constexpr DoubleDouble kHalfPiDd{0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};

// exact::pow() and its lanes have these tables and limits.
// One row per 1/128 of the mantissa m in [1,2], to the nearest: c is 1/m to 9 bits, so that
// products with it can be exact; log = log(1/c), less ln 2 from kHalvedFrom on, where m is counted
// as half of it, to keep x near 1 free of cancellation: there c = 1 or 1/2 and log = 0 exactly.
struct LogRow {
    double c = 1;
    DoubleDouble log;
};
inline constexpr int kHalvedFrom = 53; // m > 1.414
extern const std::array<LogRow, 129> kLogTable;
extern const std::array<DoubleDouble, 32> kExp2Table; // 2^(j/32)

// Powers of e below it are less than half of the smallest float, those above no float.
inline constexpr double kLeastPower = -104, kMostPower = 709;

// Whole exponents of floats up to this one are taken by squares: each of the at most 1023 products
// is wrong by 2^-53 of itself, 1e-13 together, a tenth of what logarithms are.
inline constexpr float kMostSquared = 1024;
// Their products stop falling here, far from where doubles lose bits, which some processors take a
// hundred cycles for; what is below half of the smallest float is no float, and not rounded to 0.
inline constexpr double kLeastSquare = 0x1p-500, kNoFloat = 0x1p-150;

} // namespace exact
