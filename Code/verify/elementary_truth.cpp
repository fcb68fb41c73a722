#include "verify/elementary_truth.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace truth {

namespace {

using battery::magnitude, battery::squareRoot;

Wide powerOfTwo(int k) noexcept { // |k| <= 2000
    return static_cast<Wide>(std::ldexp(1.0, k / 2)) *
           static_cast<Wide>(std::ldexp(1.0, k - k / 2));
}

// A constant in pieces of 56 bits from its hexadecimal digits: products of a piece with a whole
// number below 2^57 are exact.
using Pieces = std::array<Wide, 4>;
Pieces piecesOf(const std::array<std::uint64_t, 4>& digits, int exponentOfFirst) noexcept {
    Pieces out{};
    for (std::size_t i = 0; i < 4; ++i)
        out[i] =
            static_cast<Wide>(digits[i]) * powerOfTwo(exponentOfFirst - 56 * static_cast<int>(i));
    return out;
}
// pi/2 = half of 3.243F6A88 85A308D3 13198A2E 03707344 A4093822 299F31D0 082EFA98 ...
const Pieces kHalfPi =
    piecesOf({0x3243f6a8885a308, 0xd313198a2e0370, 0x7344a409382229, 0x9f31d0082efa98}, -57);
// ln 2 = 0.B17217F7 D1CF79AB C9E3B398 03F2F6AF 40F34326 7298B62D 8A0D175B ...
const Pieces kLn2 =
    piecesOf({0xb17217f7d1cf79, 0xabc9e3b39803f2, 0xf6af40f3432672, 0x98b62d8a0d175b}, -56);
Wide sum(const Pieces& p) { return p[0] + (p[1] + (p[2] + p[3])); }

// x - n * constant. The first differences cancel and are exact.
Wide reduced(Wide x, std::int64_t n, const Pieces& constant) {
    for (const Wide& piece : constant) x -= static_cast<Wide>(n) * piece;
    return x;
}

// Sum of term, term * ratio(2), term * ratio(2) * ratio(3), ... until it does not change.
template <class Ratio> Wide series(Wide term, Ratio ratio) {
    Wide total = term;
    for (int n = 2; n < 200; ++n) {
        term *= ratio(n);
        if (total + term == total) break;
        total += term;
    }
    return total;
}

struct SinCos {
    Wide sin, cos;
};
SinCos sinCos(Wide x) { // |x| < 2^47
    const auto n = std::llround(static_cast<double>(x / sum(kHalfPi)));
    const Wide r = reduced(x, n, kHalfPi);
    const Wide s = series(r, [&](int i) { return -r * r / ((2 * i - 1) * (2 * i - 2)); });
    const Wide c = series(1, [&](int i) { return -r * r / ((2 * i - 2) * (2 * i - 3)); });
    switch (n & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
    }
}

// The angle of (x, y). A guess turned away leaves a rest d of 2^-50, atan d = d - d^3/3.
Wide angle(Wide y, Wide x) {
    const Wide size = magnitude(x) > magnitude(y) ? magnitude(x) : magnitude(y);
    const Wide guess =
        static_cast<Wide>(std::atan2(static_cast<double>(y / size), static_cast<double>(x / size)));
    const SinCos g = sinCos(guess);
    const Wide d = (y * g.cos - x * g.sin) / (x * g.cos + y * g.sin);
    return guess + (d - d * d * d / 3);
}

Wide expOf(Wide x) {
    const auto k = std::llround(static_cast<double>(x / sum(kLn2)));
    const Wide r = reduced(x, k, kLn2);
    return series(1, [&](int i) { return r / (i - 1); }) * powerOfTwo(static_cast<int>(k));
}

} // namespace

Wide sin(double x) { return sinCos(x).sin; }
Wide cos(double x) { return sinCos(x).cos; }
Wide tan(double x) {
    const SinCos both = sinCos(x);
    return both.sin / both.cos;
}
Wide asin(double x) { return angle(x, squareRoot(1 - static_cast<Wide>(x) * x)); }
Wide acos(double x) { return angle(squareRoot(1 - static_cast<Wide>(x) * x), x); }
Wide atan2(double y, double x) { return angle(y, x); }

Wide exp(double x) { return expOf(x); }
Wide exp2(double x) { return expOf(x * sum(kLn2)); }

// x = 2^k m with m in [0.7, 1.5]: k ln 2 + 2 atanh((m-1)/(m+1)); for x near 1, k is 0.
Wide log(double x) {
    int k = 0;
    double m = std::frexp(x, &k);
    if (m < 0.7) m *= 2, --k;
    const Wide z = (static_cast<Wide>(m) - 1) / (static_cast<Wide>(m) + 1);
    Wide power = z, total = z;
    for (int n = 3; n < 200; n += 2) {
        power *= z * z;
        if (total + power / n == total) break;
        total += power / n;
    }
    return k * sum(kLn2) + 2 * total;
}
Wide log2(double x) { return log(x) / sum(kLn2); }
Wide pow(double x, double y) { return expOf(y * log(x)); }

Wide cbrt(double x) {
    if (x == 0) return x;
    Wide root = static_cast<Wide>(std::cbrt(x));
    for (int i = 0; i < 2; ++i) root -= (root - x / (root * root)) / 3;
    return root;
}

double ulpsOff(double value, Wide truth) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // The C++ cast rounds to nearest: what it makes infinite is 2^1024 less half a place or more.
    const double nearest = static_cast<double>(magnitude(truth));
    if (nearest == infinity) return std::fabs(value) == infinity ? 0 : infinity;
    int exponent = -1021; // the last place is 2^(exponent - 53), no finer than 2^-1074
    if (nearest >= 0x1p-1022) std::frexp(nearest, &exponent);
    return static_cast<double>(magnitude(static_cast<Wide>(value) - truth) *
                               powerOfTwo(53 - exponent));
}

} // namespace truth
