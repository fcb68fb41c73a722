// The functions of math.h that have to do with angles.
#include "base/function_tables.h"
#include "base/math.h"
#include "base/rounder.h"

namespace exact {

// The steps atan(k/16) - atan((k-1)/16) = atan(16 / (256 + k (k-1))) by their series.
constexpr std::array<DoubleDouble, 17> kAtanTable = [] {
    std::array<DoubleDouble, 17> table{};
    for (int k = 1; k <= 16; ++k) {
        const DoubleDouble z = DoubleDouble{16, 0} / DoubleDouble{256.0 + k * (k - 1), 0};
        const DoubleDouble minusZ2 = -(z * z);
        DoubleDouble power = z, sum = z;
        for (int n = 3; n < 29; n += 2) { // (1/16)^28 = 2^-112
            power = power * minusZ2;
            sum = sum + power / DoubleDouble{static_cast<double>(n), 0};
        }
        table[static_cast<std::size_t>(k)] = table[static_cast<std::size_t>(k - 1)] + sum;
    }
    return table;
}();

} // namespace exact

namespace {

using exact::kAtanTable, exact::kHalfPiDd;

// --- sin, cos ---

struct Reduced {
    double hi, lo;          // hi + lo in [-pi/4, pi/4], and a little more
    std::uint64_t quadrant; // the lowest two bits count
};

// Cody and Waite 1980: x - n pi/2 with pi/2 in pieces. The first three have 33 bits, so that their
// products with n < 2^20 are exact; the sum of all four is pi/2 to 151 bits.
Reduced reduceSmall(double x) {
    constexpr double p1 = 0x1.921fb544p0, p2 = 0x1.0b4611a6p-34, p3 = 0x1.3198a2ep-69;
    constexpr double p4 = 0x1.b839a252049c1p-104;
    const double shifted = x * (2 / kPi) + kRounder;
    const double n = shifted - kRounder;
    const DoubleDouble a = twoSum(x - n * p1, -(n * p2));
    const DoubleDouble b = twoSum(a.hi, -(n * p3));
    const DoubleDouble r = fastTwoSum(b.hi, (a.lo + b.lo) - n * p4);
    return {r.hi, r.lo, std::bit_cast<std::uint64_t>(shifted)};
}

// The same with exact products of 53-bit pieces, for |x| < 2^47: then n is
// the nearest whole number or its neighbour when x is within 2^-6 of the middle.
Reduced reduceLarge(double x) {
    constexpr double p3 = -0x1.f1976b7ed8fbcp-110;
    const double shifted = x * (2 / kPi) + kRounder;
    const double n = shifted - kRounder;
    const DoubleDouble first = twoProduct(n, kHalfPiDd.hi), second = twoProduct(n, kHalfPiDd.lo);
    DoubleDouble r = twoSum(x, -first.hi);
    r = r - DoubleDouble{first.lo, 0};
    r = r - second;
    r = r - DoubleDouble{n * p3, 0};
    return {r.hi, r.lo, std::bit_cast<std::uint64_t>(shifted)};
}

Reduced reduceAngle(double x) {
    if (std::fabs(x) < 0x1p20) return reduceSmall(x);
    if (std::fabs(x) < 0x1p47) return reduceLarge(x);
    return reduceSmall(std::fmod(x, kTwoPi)); // fmod is exact, hence the same everywhere
}

// Taylor, as the terms are known to be right: what is left out is below 2^-62 of the value.
// The lower part holds what the rounding to the upper one leaves out.
DoubleDouble sinKernel(double x, double lo) {
    constexpr double c3 = -1.0 / 6, c5 = 1.0 / 120, c7 = -1.0 / 5040, c9 = 1.0 / 362880;
    constexpr double c11 = -1.0 / 39916800, c13 = 1.0 / 6227020800, c15 = -1.0 / 1307674368000;
    constexpr double c17 = 1.0 / 355687428096000;
    const double z = x * x, z2 = z * z, z4 = z2 * z2;
    const double low = (c5 + z * c7) + z2 * (c9 + z * c11);
    const double high = (c13 + z * c15) + z2 * c17;
    return fastTwoSum(x, (x * z) * (c3 + z * (low + z4 * high)) + lo * (1 - 0.5 * z));
}

// What is left out is below 2^-58.
DoubleDouble cosKernel(double x, double lo) {
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40320, c10 = -1.0 / 3628800;
    constexpr double c12 = 1.0 / 479001600, c14 = -1.0 / 87178291200, c16 = 1.0 / 20922789888000;
    const double z = x * x, z2 = z * z, z4 = z2 * z2;
    const double low = (c4 + z * c6) + z2 * (c8 + z * c10);
    const double high = (c12 + z * c14) + z2 * c16;
    const double half = 0.5 * z, main = 1 - half;
    return fastTwoSum(main, ((1 - main) - half) + (z2 * (low + z4 * high) - x * lo));
}

struct WideSinCos {
    DoubleDouble sin, cos;
};
WideSinCos wideSinCos(double x) { // finite
    const Reduced r = std::fabs(x) < kPi / 4 ? Reduced{x, 0, 0} : reduceAngle(x);
    const DoubleDouble s = sinKernel(r.hi, r.lo), c = cosKernel(r.hi, r.lo);
    switch (r.quadrant & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
    }
}

// --- atan ---

// atan(t) - t for |t| <= 1/16; what is left out is below 2^-59 of t.
double atanTail(double t) {
    const double z = t * t, z2 = z * z;
    const double low = (-1.0 / 3 + z * (1.0 / 5)) + z2 * (-1.0 / 7 + z * (1.0 / 9));
    const double high = -1.0 / 11 + z * (1.0 / 13 - z * (1.0 / 15));
    return (t * z) * (low + (z2 * z2) * high);
}

// The angle of (x, y) plus a small correction; both finite or infinite, no NaN.
double angleOf(double y, double x, double correction) {
    const double absX = std::fabs(x), absY = std::fabs(y);
    double a = min(absX, absY), b = max(absX, absY);
    double hi = 0, lo = 0; // atan(a / b), in [0, pi/4]
    if (a == b) {
        if (b != 0) hi = kAtanTable[16].hi, lo = kAtanTable[16].lo;
    } else {
        const double ratio = a / b;
        if (ratio < 0.0625) {
            hi = ratio, lo = atanTail(ratio);
        } else {
            if (b > 0x1p990) a *= 0x1p-100, b *= 0x1p-100; // so that splitting cannot overflow
            if (b < 0x1p-900) a *= 0x1p200, b *= 0x1p200;  // nor the product underflow
            const int k = static_cast<int>(ratio * 16 + 0.5);
            const double c = k * 0.0625;
            const DoubleDouble cb = twoProduct(c, b);
            const double t = ((a - cb.hi) - cb.lo) / (b + c * a); // tan(angle - atan(c))
            const DoubleDouble base = kAtanTable[static_cast<std::size_t>(k)];
            hi = base.hi, lo = t + (base.lo + atanTail(t));
        }
    }
    // Now the octant: angle = base + or - (hi + lo), for y >= 0.
    double sign = 1;
    DoubleDouble base;
    if (absY > absX) {
        base = kHalfPiDd;
        sign = std::signbit(x) ? 1 : -1;
    } else if (std::signbit(x)) {
        base = {2 * kHalfPiDd.hi, 2 * kHalfPiDd.lo};
        sign = -1;
    }
    const DoubleDouble sum = twoSum(base.hi, sign * hi);
    const double angle = sum.hi + (sum.lo + (base.lo + (sign * lo + correction)));
    return std::copysign(angle, y);
}

// sqrt(1 - x^2) = hi + lo to about 100 bits, |x| < 1.
DoubleDouble cosineOfSine(double x) {
    const DoubleDouble square = twoProduct(x, x);
    DoubleDouble rest = twoSum(1, -square.hi);
    rest = fastTwoSum(rest.hi, rest.lo - square.lo);
    const double root = std::sqrt(rest.hi);
    const DoubleDouble back = twoProduct(root, root);
    return {root, ((rest.hi - back.hi) - back.lo + rest.lo) / (2 * root)};
}

} // namespace

namespace exact {

SinCos sinCos(double x) {
    if (!(std::fabs(x) < kInfinity)) return {kQuietNaN, kQuietNaN};
    if (std::fabs(x) < 0x1p-27) return {x, 1};
    const WideSinCos both = wideSinCos(x);
    return {both.sin.hi, both.cos.hi};
}

double sin(double x) {
    if (!(std::fabs(x) < kInfinity)) return kQuietNaN;
    if (std::fabs(x) < 0x1p-27) return x; // keeps -0, and no denormals arise
    const Reduced r = std::fabs(x) < kPi / 4 ? Reduced{x, 0, 0} : reduceAngle(x);
    const double value = (r.quadrant & 1 ? cosKernel(r.hi, r.lo) : sinKernel(r.hi, r.lo)).hi;
    return r.quadrant & 2 ? -value : value;
}

double cos(double x) {
    if (!(std::fabs(x) < kInfinity)) return kQuietNaN;
    const Reduced r = std::fabs(x) < kPi / 4 ? Reduced{x, 0, 0} : reduceAngle(x);
    const double value = (r.quadrant & 1 ? sinKernel(r.hi, r.lo) : cosKernel(r.hi, r.lo)).hi;
    return (r.quadrant + 1) & 2 ? -value : value;
}

double tan(double x) {
    if (!(std::fabs(x) < kInfinity)) return kQuietNaN;
    if (std::fabs(x) < 0x1p-27) return x;
    const WideSinCos both = wideSinCos(x);
    return (both.sin / both.cos).hi;
}

double atan2(double y, double x) {
    if (x != x || y != y) return kQuietNaN;
    return angleOf(y, x, 0);
}

double atan(double x) { return x != x ? kQuietNaN : angleOf(x, 1, 0); }

// The angle of the point (sqrt(1-x^2), x) on the unit circle; where the root is off by lo, the
// angle is off by -x lo.
double asin(double x) {
    if (!(std::fabs(x) <= 1)) return kQuietNaN;
    if (std::fabs(x) < 0x1p-27) return x;
    if (std::fabs(x) == 1) return std::copysign(kHalfPi, x);
    const DoubleDouble cosine = cosineOfSine(x);
    return angleOf(x, cosine.hi, -std::fabs(x) * cosine.lo);
}

double acos(double x) {
    if (!(std::fabs(x) <= 1)) return kQuietNaN;
    if (std::fabs(x) == 1) return x > 0 ? 0 : kPi;
    const DoubleDouble sine = cosineOfSine(x);
    return angleOf(sine.hi, x, x * sine.lo);
}

} // namespace exact
