// The real roots of a t^2 + b t + c = 0, safe against cancellation and overflow.
// Knows nothing about shapes.
#pragma once

#include "base/math.h"

struct Roots {
    int count = 0;         // 0, 1 or 2
    double t0 = 0, t1 = 0; // ascending; with one root t1 == t0
    constexpr bool operator==(const Roots&) const = default;
};

namespace quadratic {

constexpr Roots ordered(double s, double t) {
    if (!(std::fabs(s) < kInfinity)) s = t;
    if (!(std::fabs(t) < kInfinity)) t = s;
    if (!(std::fabs(s) < kInfinity)) return {};
    if (s == t) return {1, s, s};
    return s < t ? Roots{2, s, t} : Roots{2, t, s};
}

// Coefficients whose products neither overflow nor underflow, and a != 0.
inline Roots solveScaled(double a, double b, double c) {
    const double discriminant = differenceOfProducts(b, b, 4 * a, c);
    if (!(discriminant >= 0)) return {};
    // The sum that does not cancel (Press et al., Numerical Recipes 5.6).
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    if (q == 0) return {1, 0, 0}; // b == c == 0
    return ordered(q / a, c / q);
}

} // namespace quadratic

// The discriminant is good to 2 ulp even where b^2 and 4 a c cancel, so its sign is right, and no
// root comes from a sum that cancels: the relative error of each root is below 4 ulp, for the
// coefficients as given. A double root counts once. a == 0 gives the root of the line; a == b == 0
// none, even if c == 0: a surface that the ray lies in is not hit. A root too large for a double
// is left out, and NaN or infinite coefficients give none.
inline Roots solveQuadratic(double a, double b, double c) {
    if (!(std::fabs(a) < kInfinity && std::fabs(b) < kInfinity && std::fabs(c) < kInfinity))
        return {};
    if (a == 0) return b == 0 ? Roots{} : quadratic::ordered(-c / b, -c / b);
    const auto isModerate = [](double x) {
        return x == 0 || (std::fabs(x) > 0x1p-240 && std::fabs(x) < 0x1p240);
    };
    if (isModerate(a) && isModerate(b) && isModerate(c)) return quadratic::solveScaled(a, b, c);
    // t = 2^k s brings a and c to one size, then all are divided by the largest; frexp and ldexp
    // are exact.
    const auto exponentOf = [](double x) {
        int exponent = 0;
        std::frexp(x, &exponent);
        return exponent;
    };
    int k = 0;
    if (c != 0)
        k = (exponentOf(c) - exponentOf(a)) / 2;
    else if (b != 0)
        k = exponentOf(b) - exponentOf(a);
    int largest = exponentOf(a) + k;
    if (b != 0 && exponentOf(b) > largest) largest = exponentOf(b);
    const Roots roots = quadratic::solveScaled(std::ldexp(a, k - largest), std::ldexp(b, -largest),
                                               std::ldexp(c, -k - largest));
    if (roots.count == 0) return {};
    return quadratic::ordered(std::ldexp(roots.t0, k), std::ldexp(roots.t1, k));
}
