// On which side of a line a point lies, without rounding: what keeps the decisions of triangulate()
// free of contradictions. Knows nothing of polygons.
#pragma once

#include "base/double_double.h"
#include "base/vec.h"

#include <cmath>

// The sign of a sum of doubles, exactly, by growing an expansion: terms of increasing size that do
// not overlap (Shewchuk 1997). At most `kTerms` summands.
template <int kTerms> class ExactSum {
public:
    void add(double term) {
        for (int i = 0; i < count_; ++i) {
            const DoubleDouble sum = twoSum(term, terms_[i]);
            terms_[i] = sum.lo;
            term = sum.hi;
        }
        terms_[count_++] = term;
    }
    void add(DoubleDouble pair) {
        add(pair.lo);
        add(pair.hi);
    }
    int sign() const { // that of the largest term which is not zero
        for (int i = count_; i-- > 0;)
            if (terms_[i] != 0) return terms_[i] > 0 ? 1 : -1;
        return 0;
    }

private:
    double terms_[kTerms];
    int count_ = 0;
};

inline int exactOrientation(Vec2d a, Vec2d b, Vec2d c) {
    ExactSum<12> area;
    area.add(twoProduct(a.x, b.y));
    area.add(twoProduct(-a.y, b.x));
    area.add(twoProduct(b.x, c.y));
    area.add(twoProduct(-b.y, c.x));
    area.add(twoProduct(c.x, a.y));
    area.add(twoProduct(-c.y, a.x));
    return area.sign();
}

// (3 + 16u) u with u = 2^-53: Shewchuk's bound for the order of operations below.
inline constexpr double kOrientationError = 3.3306690738754716e-16;

// 1: a, b, c turn left (counter-clockwise), -1: right, 0: they lie on one line. Exact for
// coordinates up to 1e60 whose products are not below 2^-968.
inline int orientation(Vec2d a, Vec2d b, Vec2d c) {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    if (left == 0 && right == 0) return 0; // what lies on lines along the axes is common
    const double area = left - right;
    const double error = kOrientationError * (std::fabs(left) + std::fabs(right));
    if (area > error) return 1;
    if (area < -error) return -1;
    return exactOrientation(a, b, c);
}

// Is their orientation not 0? False as well where only exactOrientation() knows. Asks for no sign,
// which nobody can guess.
inline bool surelyTurn(Vec2d a, Vec2d b, Vec2d c) {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    return std::fabs(left - right) > kOrientationError * (std::fabs(left) + std::fabs(right));
}
