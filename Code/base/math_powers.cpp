// The functions of math.h that have to do with powers.
#include "base/double_double.h"
#include "base/math.h"
#include "base/function_tables.h"
#include "base/rounder.h"

#include <array>

namespace {

constexpr DoubleDouble logBySeries(DoubleDouble x) { // x in [0.5, 2]: 2 atanh((x-1)/(x+1))
    const DoubleDouble z = (x - DoubleDouble{1, 0}) / (x + DoubleDouble{1, 0}), z2 = z * z;
    DoubleDouble power = z, sum = z;
    for (int n = 3; n < 71; n += 2) { // (1/3)^70 = 2^-111
        power = power * z2;
        sum = sum + power / DoubleDouble{static_cast<double>(n), 0};
    }
    return {2 * sum.hi, 2 * sum.lo};
}

} // namespace

namespace exact {

constexpr std::array<LogRow, 129> kLogTable = [] {
    std::array<LogRow, 129> table{};
    for (int j = 0; j <= 128; ++j) {
        const int c512 = (2 * 65536 / (128 + j) + 1) / 2; // 512 / (1 + j/128), rounded
        LogRow& row = table[static_cast<std::size_t>(j)];
        row.c = c512 / 512.0;
        const double counted = j >= kHalvedFrom ? 2 * row.c : row.c;
        row.log = -logBySeries({counted, 0});
    }
    return table;
}();

constexpr std::array<DoubleDouble, 32> kExp2Table = [] {
    std::array<DoubleDouble, 32> table{};
    constexpr DoubleDouble step{0x1.059b0d3158574p0, 0x1.d73e2a475b465p-55}; // 2^(1/32)
    table[0] = {1, 0};
    for (std::size_t j = 1; j < 32; ++j) table[j] = table[j - 1] * step;
    return table;
}();

} // namespace exact

namespace {

using exact::kExp2Table, exact::kHalvedFrom, exact::kLogTable, exact::LogRow;

constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

double scaleByPowerOf2(double x, int exponent) { // exponent in [-1022, 1023]
    return x * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// --- exp ---

// 2^(n/32) e^r for |r| < 0.011; what is left out of the series is below 2^-67.
double expScaled(long long n, double r) {
    const double r2 = r * r;
    const double low = 0.5 + r * (1.0 / 6), high = 1.0 / 24 + r * (1.0 / 120);
    const double tail = r2 * (low + r2 * (high + r2 * (1.0 / 720 + r * (1.0 / 5040))));
    const DoubleDouble base = kExp2Table[static_cast<std::size_t>(n & 31)];
    const double value = base.hi + (base.lo + base.hi * (r + tail));
    const int k = static_cast<int>(n >> 5);
    if (k > -1022 && k < 1023) return scaleByPowerOf2(value, k);
    // Denormal and largest results: two steps, so that the power of two itself is a number.
    return scaleByPowerOf2(scaleByPowerOf2(value, k / 2), k - k / 2);
}

// e^(hi + lo)
double expOf(double hi, double lo) {
    if (hi > 709.8) return kInfinity;
    if (hi < -745.2) return 0;
    if (hi != hi) return hi;
    // 32 bits of ln2/32, so that its product with n < 2^16 is exact, and the rest.
    constexpr double step1 = 0x1.62e42feep-6, step2 = 0x1.a39ef35793c76p-38;
    const double shifted = hi * (32 / kLn2.hi) + kRounder;
    const double n = shifted - kRounder;
    return expScaled(static_cast<long long>(n), ((hi - n * step1) - n * step2) + lo);
}

// --- log ---

struct LogParts {
    double exponent; // of 2, whole
    double mantissa; // in [1,2)
    const LogRow* row;
};
LogParts logParts(double x) { // x > 0, finite
    double exponent = -1023;
    if (x < 0x1p-1022) x *= 0x1p54, exponent -= 54;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t fraction = bits & 0xfffffffffffffu;
    const auto j = static_cast<std::size_t>((fraction + (std::uint64_t{1} << 44)) >> 45);
    exponent += static_cast<double>(bits >> 52) + (j >= kHalvedFrom ? 1 : 0);
    return {exponent, std::bit_cast<double>(fraction | 0x3ff0000000000000u), &kLogTable[j]};
}

// (log(1+r) - r + r^2/2) / r^3 for |r| < 2^-7 (1 + 1/4); what is left out is below 2^-68 / r^2.
double logTail(double r) {
    const double r2 = r * r;
    const double low = (1.0 / 3 - r * (1.0 / 4)) + r2 * (1.0 / 5 - r * (1.0 / 6));
    const double high = (1.0 / 7 - r * (1.0 / 8)) + r2 * (1.0 / 9 - r * (1.0 / 10));
    return low + (r2 * r2) * high;
}

// log(x) to a relative error of about 2^-66, for x > 0 and finite.
DoubleDouble logOf(double x) {
    const LogParts parts = logParts(x);
    const double c = parts.row->c;
    // 27 and 26 bits times 9: exact; the first difference cancels and is exact as well.
    const double upper =
        std::bit_cast<double>(std::bit_cast<std::uint64_t>(parts.mantissa) & ~0x3ffffffull);
    const DoubleDouble r = fastTwoSum(upper * c - 1, (parts.mantissa - upper) * c);
    const DoubleDouble square = twoProduct(r.hi, r.hi);
    DoubleDouble sum = fastTwoSum(r.hi, -0.5 * square.hi);
    sum.lo += r.lo - (r.hi * r.lo + 0.5 * square.lo) + (r.hi * square.hi) * logTail(r.hi);
    const double k = parts.exponent;
    // k ln2 with the upper part short enough to be exact.
    constexpr double ln2Upper = 0x1.62e42fefa38p-1, ln2Lower = 0x1.ef35793c7673p-45;
    const DoubleDouble table = twoSum(k * ln2Upper, parts.row->log.hi);
    const DoubleDouble total = twoSum(table.hi, sum.hi);
    return fastTwoSum(total.hi,
                      total.lo + (table.lo + (sum.lo + (parts.row->log.lo + k * ln2Lower))));
}

// From 2^53 on (infinity included) all doubles are whole and even.
bool isWhole(double y) {
    return std::fabs(y) >= 0x1p53 || static_cast<double>(static_cast<long long>(y)) == y;
}
bool isOdd(double y) {
    return isWhole(y) && std::fabs(y) < 0x1p53 && (static_cast<long long>(y) & 1) != 0;
}

// x^n by the bits of n >= 1, the lowest first.
float powBySquares(double x, unsigned n) {
    double result = 1;
    for (;; x = max(x * x, exact::kLeastSquare)) {
        if ((n & 1) != 0) result = max(result * x, exact::kLeastSquare);
        n >>= 1;
        if (n == 0) return result < exact::kNoFloat ? 0 : static_cast<float>(result);
    }
}

} // namespace

namespace exact {

double exp(double x) { return expOf(x, 0); }

double exp2(double x) {
    if (x >= 1024) return kInfinity;
    if (x < -1075) return 0;
    if (x != x) return x;
    const double shifted = x * 32 + kRounder;
    const double n = shifted - kRounder;
    return expScaled(static_cast<long long>(n), (x - n * 0.03125) * kLn2.hi);
}

double log(double x) {
    if (!(x > 0)) return x == 0 ? -kInfinity : kQuietNaN;
    if (x == kInfinity) return x;
    const DoubleDouble value = logOf(x);
    return value.hi + value.lo;
}

double log2(double x) {
    if (!(x > 0)) return x == 0 ? -kInfinity : kQuietNaN;
    if (x == kInfinity) return x;
    constexpr DoubleDouble inverseLn2{0x1.71547652b82fep0, 0x1.777d0ffda0d24p-56};
    const DoubleDouble value = logOf(x) * inverseLn2;
    return value.hi + value.lo;
}

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    if (x != x || y != y) return kQuietNaN;
    double sign = 1;
    if (std::signbit(x)) {
        if (isOdd(y))
            sign = -1;
        else if (x < 0 && x > -kInfinity && !isWhole(y))
            return kQuietNaN;
        x = -x;
        if (x == 1) return sign;
    }
    if (x == 0) return y > 0 ? sign * 0.0 : sign * kInfinity;
    if (x == kInfinity) return y > 0 ? sign * kInfinity : sign * 0.0;
    // |log x| is at least 2^-53 here, so such exponents end at 0 or infinity.
    if (std::fabs(y) > 0x1p64) return sign * ((y > 0) == (x > 1) ? kInfinity : 0.0);
    const DoubleDouble log = logOf(x);
    const DoubleDouble power = twoProduct(y, log.hi);
    return sign * expOf(power.hi, power.lo + y * log.lo);
}

// fdlibm's plan: a start from the exponent, one step with t*t exact.
double cbrt(double x) {
    if (x == 0 || !(std::fabs(x) < kInfinity)) return x;
    double size = std::fabs(x), unit = 1;
    // Its power 4/3 is needed below; numbers near the least one are moved far enough by 2^540.
    if (size < 0x1p-700) size *= 0x1p540, unit = 0x1p-180;
    if (size > 0x1p700) size *= 0x1p-540, unit = 0x1p180;
    // A third of the exponent; the constant centres the error of 5 %.
    const auto third = std::bit_cast<std::uint64_t>(size) / 3 + 0x2a9f7893782da1ceu;
    double t = std::bit_cast<double>(third);
    for (int i = 0; i < 2; ++i) { // Halley: 5e-2, 5e-5, 5e-14
        const double cube = t * t * t;
        t = t * (cube + 2 * size) / (2 * cube + size);
    }
    t = std::bit_cast<double>(std::bit_cast<std::uint64_t>(t) & ~0x7ffffffull); // 26 bits
    const double rest = size / (t * t) - t;
    t += t * (rest / (3 * t + rest));
    return std::copysign(t * unit, x);
}

// The same steps as above in plain double: its error of 1e-12 decides the float's last bit rarely.
float pow(float base, float exponent) {
    if (exponent == 0 || base == 1) return 1;
    if (!(base > 0 && base < kInfinityF) || !(std::fabs(exponent) < kInfinityF)) {
        if (base < 0) return static_cast<float>(kQuietNaN);
        return static_cast<float>(pow(static_cast<double>(base), static_cast<double>(exponent)));
    }
    if (exponent >= 1 && exponent <= kMostSquared) {
        const auto whole = static_cast<unsigned>(exponent);
        if (static_cast<float>(whole) == exponent) return powBySquares(base, whole);
    }
    const LogParts parts = logParts(base);
    const double r = parts.mantissa * parts.row->c - 1, r2 = r * r;
    const double log =
        parts.exponent * kLn2.hi + parts.row->log.hi + (r + r2 * (-0.5 + r * logTail(r)));
    const double power = exponent * log;
    if (power < kLeastPower) return 0; // faster than rounding to it
    return static_cast<float>(expOf(min(power, kMostPower), 0));
}

} // namespace exact
