// Range: what a number in a scene may be, and the words for it.
// The bounds keep squares and products of lengths far from the end of double, and colours far from
// the end of float, so that no later step meets an infinity.
#pragma once

#include "base/text.h"

#include <limits>
#include <string>

struct Range {
    double lo = 0, hi = 0;
    bool aboveLo = false;                         // lo itself is excluded
    constexpr bool contains(double value) const { // false for NaN
        return (aboveLo ? value > lo : value >= lo) && value <= hi;
    }
};

inline constexpr double kLargestLength = 1e60;
inline constexpr double kLargestColor = 1e15;
inline constexpr double kLargestAngleDeg = 1e6; // more turns than that are a mistake
inline constexpr double kEndless = std::numeric_limits<double>::infinity(); // `inf` in a scene
inline constexpr double kLargestUnsigned = 4294967295.0;

inline constexpr Range kAnyNumber{-kLargestLength, kLargestLength};
inline constexpr Range kNotNegative{0, kLargestLength};
inline constexpr Range kPositive{0, kLargestLength, true};
inline constexpr Range kUnit{0, 1};
inline constexpr Range kMaybeEndless{0, kEndless};
inline constexpr Range kColor{0, kLargestColor};
inline constexpr Range kTurn{-kLargestAngleDeg, kLargestAngleDeg};
inline constexpr Range kAnyUnsigned{0, kLargestUnsigned};

// "must be > 0", "must be from 0 to 1": huge bounds are named only when they are what is violated.
inline std::string mustBe(const Range& range, double value) {
    const bool hasEnd = range.hi < kLargestColor;
    if (!hasEnd && value > range.hi) return "must be at most " + shortest(range.hi);
    if (!hasEnd) return cat("must be ", range.aboveLo ? "> " : ">= ", shortest(range.lo));
    if (range.aboveLo)
        return cat("must be > ", shortest(range.lo), " and at most ", shortest(range.hi));
    return cat("must be from ", shortest(range.lo), " to ", shortest(range.hi));
}
