// Double-double: unevaluated sums hi + lo of two doubles, about 106 bits. For the few places where
// 53 bits are too few; usable in constant expressions, so that tables can be computed by formula.
// FMA is banned (the bits would depend on the CPU), so products are split as Dekker 1971 does.
#pragma once

struct DoubleDouble {
    double hi = 0, lo = 0; // |lo| <= ulp(hi)/2
};

// Exact for all a, b without overflow (Knuth).
constexpr DoubleDouble twoSum(double a, double b) {
    const double sum = a + b, b2 = sum - a;
    return {sum, (a - (sum - b2)) + (b - b2)};
}
// Exact when |a| >= |b| or a == 0.
constexpr DoubleDouble fastTwoSum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}
// 26 upper and 26 signed lower bits (Veltkamp); overflows beyond 2^996.
constexpr DoubleDouble split(double a) {
    const double scaled = a * 134217729.0; // 2^27 + 1
    const double hi = scaled - (scaled - a);
    return {hi, a - hi};
}
// Exact while |a|, |b| < 2^996 and the product is in 2^-968 .. 2^1020.
constexpr DoubleDouble twoProduct(double a, double b) {
    const double product = a * b;
    const DoubleDouble x = split(a), y = split(b);
    return {product, x.lo * y.lo - (((product - x.hi * y.hi) - x.lo * y.hi) - x.hi * y.lo)};
}

constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble hi = twoSum(a.hi, b.hi), lo = twoSum(a.lo, b.lo);
    const DoubleDouble sum = fastTwoSum(hi.hi, hi.lo + lo.hi);
    return fastTwoSum(sum.hi, sum.lo + lo.lo);
}
constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }
constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }
constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble product = twoProduct(a.hi, b.hi);
    return fastTwoSum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}
constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
    const double first = a.hi / b.hi;
    const DoubleDouble rest = a - b * DoubleDouble{first, 0};
    return fastTwoSum(first, rest.hi / b.hi);
}
