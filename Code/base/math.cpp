#include "base/math.h"

#include "base/double_double.h"
#include "base/pow_tables.h"

#include <array>

double differenceOfProducts(double a, double b, double c, double d) {
    const DoubleDouble ab = twoProduct(a, b), cd = twoProduct(c, d);
    const DoubleDouble hi = twoSum(ab.hi, -cd.hi), lo = twoSum(ab.lo, -cd.lo);
    const DoubleDouble sum = twoSum(hi.hi, lo.hi);
    return sum.hi + (sum.lo + (hi.lo + lo.lo));
}

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Adding and taking away 1.5 * 2^52 rounds to the nearest whole number, ties to even; the low bits
// of the sum hold that number.
constexpr double kRounder = 0x1.8p52;

constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
constexpr DoubleDouble kHalfPiDd{0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};

double scaleByPowerOf2(double x, int exponent) { // exponent in [-1022, 1023]
    return x * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

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

// atan(k/16): the steps atan(k/16) - atan((k-1)/16) = atan(16 / (256 + k (k-1))) by their series.
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

// --- exp ---

// 2^(j/32)
constexpr std::array<DoubleDouble, 32> kExp2Table = [] {
    std::array<DoubleDouble, 32> table{};
    constexpr DoubleDouble step{0x1.059b0d3158574p0, 0x1.d73e2a475b465p-55}; // 2^(1/32)
    table[0] = {1, 0};
    for (std::size_t j = 1; j < 32; ++j) table[j] = table[j - 1] * step;
    return table;
}();

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

// One row per 1/128 of the mantissa m in [1,2]: c is 1/m to 9 bits, so that products with it can be
// exact; log = log(1/c), less ln 2 where m is counted as half of it, to keep x near 1 free of
// cancellation: there c = 1 or 1/2 and log = 0 exactly.
struct LogRow {
    double c = 1;
    DoubleDouble log;
};
using exact::kHalvedFrom; // m > 1.414

constexpr DoubleDouble logBySeries(DoubleDouble x) { // x in [0.5, 2]: 2 atanh((x-1)/(x+1))
    const DoubleDouble z = (x - DoubleDouble{1, 0}) / (x + DoubleDouble{1, 0}), z2 = z * z;
    DoubleDouble power = z, sum = z;
    for (int n = 3; n < 71; n += 2) { // (1/3)^70 = 2^-111
        power = power * z2;
        sum = sum + power / DoubleDouble{static_cast<double>(n), 0};
    }
    return {2 * sum.hi, 2 * sum.lo};
}

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

} // namespace

namespace exact {

SinCos sinCos(double x) {
    if (!(std::fabs(x) < kInfinity)) return {kNaN, kNaN};
    if (std::fabs(x) < 0x1p-27) return {x, 1};
    const WideSinCos both = wideSinCos(x);
    return {both.sin.hi, both.cos.hi};
}

double sin(double x) {
    if (!(std::fabs(x) < kInfinity)) return kNaN;
    if (std::fabs(x) < 0x1p-27) return x; // keeps -0, and no denormals arise
    const Reduced r = std::fabs(x) < kPi / 4 ? Reduced{x, 0, 0} : reduceAngle(x);
    const double value = (r.quadrant & 1 ? cosKernel(r.hi, r.lo) : sinKernel(r.hi, r.lo)).hi;
    return r.quadrant & 2 ? -value : value;
}

double cos(double x) {
    if (!(std::fabs(x) < kInfinity)) return kNaN;
    const Reduced r = std::fabs(x) < kPi / 4 ? Reduced{x, 0, 0} : reduceAngle(x);
    const double value = (r.quadrant & 1 ? sinKernel(r.hi, r.lo) : cosKernel(r.hi, r.lo)).hi;
    return (r.quadrant + 1) & 2 ? -value : value;
}

double tan(double x) {
    if (!(std::fabs(x) < kInfinity)) return kNaN;
    if (std::fabs(x) < 0x1p-27) return x;
    const WideSinCos both = wideSinCos(x);
    return (both.sin / both.cos).hi;
}

double atan2(double y, double x) {
    if (x != x || y != y) return kNaN;
    return angleOf(y, x, 0);
}

double atan(double x) { return x != x ? kNaN : angleOf(x, 1, 0); }

// The angle of the point (sqrt(1-x^2), x) on the unit circle; where the root is off by lo, the
// angle is off by -x lo.
double asin(double x) {
    if (!(std::fabs(x) <= 1)) return kNaN;
    if (std::fabs(x) < 0x1p-27) return x;
    if (std::fabs(x) == 1) return std::copysign(kHalfPi, x);
    const DoubleDouble cosine = cosineOfSine(x);
    return angleOf(x, cosine.hi, -std::fabs(x) * cosine.lo);
}

double acos(double x) {
    if (!(std::fabs(x) <= 1)) return kNaN;
    if (std::fabs(x) == 1) return x > 0 ? 0 : kPi;
    const DoubleDouble sine = cosineOfSine(x);
    return angleOf(sine.hi, x, x * sine.lo);
}

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
    if (!(x > 0)) return x == 0 ? -kInfinity : kNaN;
    if (x == kInfinity) return x;
    const DoubleDouble value = logOf(x);
    return value.hi + value.lo;
}

double log2(double x) {
    if (!(x > 0)) return x == 0 ? -kInfinity : kNaN;
    if (x == kInfinity) return x;
    constexpr DoubleDouble inverseLn2{0x1.71547652b82fep0, 0x1.777d0ffda0d24p-56};
    const DoubleDouble value = logOf(x) * inverseLn2;
    return value.hi + value.lo;
}

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    if (x != x || y != y) return kNaN;
    double sign = 1;
    if (std::signbit(x)) {
        if (isOdd(y))
            sign = -1;
        else if (x < 0 && x > -kInfinity && !isWhole(y))
            return kNaN;
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

constexpr PowTables kPowTables = [] {
    PowTables tables{};
    for (std::size_t j = 0; j < kLogTable.size(); ++j)
        tables.c[j] = kLogTable[j].c, tables.log[j] = kLogTable[j].log.hi;
    for (std::size_t j = 0; j < kExp2Table.size(); ++j)
        tables.powersHi[j] = kExp2Table[j].hi, tables.powersLo[j] = kExp2Table[j].lo;
    return tables;
}();

// The same steps as above in plain double: its error of 1e-12 decides the float's last bit rarely.
float pow(float base, float exponent) {
    if (exponent == 0 || base == 1) return 1;
    if (!(base > 0 && base < kInfinityF) || !(std::fabs(exponent) < kInfinityF)) {
        if (base < 0) return static_cast<float>(kNaN);
        return static_cast<float>(pow(static_cast<double>(base), static_cast<double>(exponent)));
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
