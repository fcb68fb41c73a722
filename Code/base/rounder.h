// Rounding doubles to whole numbers with one addition.
#pragma once

// Adding and taking away 1.5 * 2^52 rounds to the nearest whole number, ties to even; the low bits
// of the sum hold that number.
inline constexpr double kRounder = 0x1.8p52;
