#include "base/math.h"
#include "check.h"

#include <cstdint>
#include <limits>
#include <random>

// The truth is the C library's long double (64 bits on x86-64, 113 on Arm), whose own error of one
// of its units is below 0.001 ulp of a double. Against 113 bits, where functions go wrong: T12 of
// the battery (verify/elementary.cpp).

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The gap between doubles at the true value.
long double ulpAt(long double truth) {
    const long double size = std::fabs(truth);
    if (size < 0x1p-1022L) return 0x1p-1074L;
    int exponent = 0;
    std::frexp(size, &exponent);
    return std::ldexp(1.0L, exponent - 53);
}

// Checks one function over random arguments from `next`; shows the largest error if it fails.
template <class Function, class Truth, class Next>
void checkUlp(const char* name, double bound, int count, Function function, Truth truth,
              Next next) {
    double worst = 0, worstAt = 0;
    for (int i = 0; i < check::scaled(count); ++i) {
        const double x = next();
        const long double expected = truth(static_cast<long double>(x));
        const double value = function(x);
        const double error = static_cast<double>(
            std::fabs(static_cast<long double>(value) - expected) / ulpAt(expected));
        // NaN is worse than any number, and stays.
        if (worst == worst && !(error <= worst)) worst = error, worstAt = x;
    }
    CHECK_INFO(worst <= bound, name << ": " << worst << " ulp at " << std::hexfloat << worstAt);
}

struct Draw {
    std::mt19937_64 engine{20240611}; // the seed of all tests here
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
    // Evenly spread in the exponent, both signs.
    double spread(double loExponent, double hiExponent) {
        const double size = std::exp2(uniform(loExponent, hiExponent));
        return engine() & 1 ? size : -size;
    }
};

constexpr int kCount = 200000;

} // namespace

TEST(math_sin_cos_tan) {
    Draw draw;
    const auto sinL = [](long double x) { return std::sin(x); };
    const auto cosL = [](long double x) { return std::cos(x); };
    const auto tanL = [](long double x) { return std::tan(x); };
    const auto small = [&] { return draw.uniform(-10, 10); };
    const auto wide = [&] { return draw.spread(-30, 20); };
    const auto large = [&] { return draw.spread(20, 46.9); };
    // The doubles next to multiples of pi/2, where the reduction cancels most.
    const auto near = [&] {
        const double n = std::floor(draw.uniform(-1e6, 1e6));
        return n * kHalfPi * (1 + draw.uniform(-2, 2) * 0x1p-52);
    };
    checkUlp("sin small", 0.85, kCount, exact::sin, sinL, small);
    checkUlp("sin wide", 0.85, kCount, exact::sin, sinL, wide);
    checkUlp("sin large", 0.85, kCount, exact::sin, sinL, large);
    checkUlp("sin near", 0.85, kCount, exact::sin, sinL, near);
    checkUlp("cos small", 0.85, kCount, exact::cos, cosL, small);
    checkUlp("cos wide", 0.85, kCount, exact::cos, cosL, wide);
    checkUlp("cos large", 0.85, kCount, exact::cos, cosL, large);
    checkUlp("cos near", 0.85, kCount, exact::cos, cosL, near);
    checkUlp("tan small", 1.1, kCount, exact::tan, tanL, small);
    checkUlp("tan near", 1.1, kCount, exact::tan, tanL, near);
    checkUlp("tan large", 1.1, kCount, exact::tan, tanL, large);
    for (int i = 0; i < check::scaled(1000); ++i) { // one reduction for both, the same bits
        const double x = wide();
        CHECK_EQUAL(exact::sinCos(x).sin, exact::sin(x));
        CHECK_EQUAL(exact::sinCos(x).cos, exact::cos(x));
    }
}

TEST(math_sin_special) {
    CHECK_EQUAL(exact::sin(0.0), 0.0);
    CHECK(std::signbit(exact::sin(-0.0)));
    CHECK_EQUAL(exact::cos(0.0), 1.0);
    CHECK_EQUAL(exact::sin(1e-310), 1e-310);
    CHECK_EQUAL(exact::sin(kHalfPi), 1.0);
    CHECK_NEAR(exact::sin(kPi / 6), 0.5, 1e-16);
    for (const double x : {kInfinity, -kInfinity, kNaN}) {
        CHECK(std::isnan(exact::sin(x)));
        CHECK(std::isnan(exact::cos(x)));
        CHECK(std::isnan(exact::tan(x)));
    }
    for (const double x : {1e16, -1e100, 1.7e308}) {
        CHECK(std::fabs(exact::sin(x)) <= 1);
        CHECK_NEAR(std::hypot(exact::sin(x), exact::cos(x)), 1, 1e-15);
    }
}

TEST(math_atan_asin_acos) {
    Draw draw;
    const auto atanL = [](long double x) { return std::atan(x); };
    const auto asinL = [](long double x) { return std::asin(x); };
    const auto acosL = [](long double x) { return std::acos(x); };
    checkUlp("atan", 1.5, kCount, exact::atan, atanL, [&] { return draw.spread(-40, 40); });
    const auto middle = [&] { return draw.uniform(0.05, 2); };
    checkUlp("atan 0.05..2", 1.5, kCount, exact::atan, atanL, middle);
    const auto unit = [&] { return draw.uniform(-1, 1); };
    const auto small = [&] { return draw.spread(-30, 0); };
    const auto nearOne = [&] { return 1 - std::fabs(draw.spread(-52, 0)); };
    checkUlp("asin", 1.5, kCount, exact::asin, asinL, unit);
    checkUlp("asin small", 1.5, kCount, exact::asin, asinL, small);
    checkUlp("asin near 1", 1.5, kCount, exact::asin, asinL, nearOne);
    checkUlp("acos", 1.5, kCount, exact::acos, acosL, unit);
    checkUlp("acos small", 1.5, kCount, exact::acos, acosL, small);
    checkUlp("acos near 1", 1.5, kCount, exact::acos, acosL, nearOne);
    CHECK_EQUAL(exact::asin(1.0), kHalfPi);
    CHECK_EQUAL(exact::asin(-1.0), -kHalfPi);
    CHECK_EQUAL(exact::acos(1.0), 0.0);
    CHECK_EQUAL(exact::acos(-1.0), kPi);
    CHECK_EQUAL(exact::acos(0.0), kHalfPi);
    CHECK(std::isnan(exact::asin(1.0000000000000002)));
    CHECK(std::isnan(exact::acos(-2.0)));
    CHECK(std::isnan(exact::acos(kNaN)));
    CHECK_EQUAL(exact::atan(kInfinity), kHalfPi);
    CHECK(std::isnan(exact::atan(kNaN)));
}

TEST(math_atan2) {
    Draw draw;
    for (const double exponents : {3.0, 300.0}) {
        double x = 0;
        checkUlp(
            "atan2", 1.5, kCount, [&](double y) { return exact::atan2(y, x); },
            [&](long double y) { return std::atan2(y, static_cast<long double>(x)); },
            [&] {
                x = draw.spread(-exponents, exponents);
                return draw.spread(-exponents, exponents);
            });
    }
    // All pairs of special values agree with the C library to the last bit, signs of zero included.
    const double denormal = 4e-324, largest = std::numeric_limits<double>::max();
    const double values[] = {0.0, 1.0, denormal, largest, kInfinity};
    for (const double a : values)
        for (const double b : values)
            for (const double y : {a, -a})
                for (const double x : {b, -b}) {
                    const double value = exact::atan2(y, x), expected = std::atan2(y, x);
                    CHECK_INFO(value == expected && std::signbit(value) == std::signbit(expected),
                               "atan2(" << y << ", " << x << ") = " << value);
                }
    CHECK(std::isnan(exact::atan2(kNaN, 1.0)));
    CHECK(std::isnan(exact::atan2(1.0, kNaN)));
}

TEST(math_exp_log) {
    Draw draw;
    const auto expL = [](long double x) { return std::exp(x); };
    const auto exp2L = [](long double x) { return std::exp2(x); };
    const auto logL = [](long double x) { return std::log(x); };
    const auto log2L = [](long double x) { return std::log2(x); };
    checkUlp("exp", 0.75, kCount, exact::exp, expL, [&] { return draw.uniform(-745, 709.7); });
    checkUlp("exp near 0", 0.75, kCount, exact::exp, expL, [&] { return draw.spread(-60, 3); });
    checkUlp("exp2", 0.75, kCount, exact::exp2, exp2L, [&] { return draw.uniform(-1074, 1023.9); });
    const auto positive = [&] { return std::fabs(draw.spread(-1074, 1023.9)); };
    const auto nearOne = [&] { return 1 + draw.spread(-50, -1); };
    checkUlp("log", 0.55, kCount, exact::log, logL, positive);
    checkUlp("log near 1", 0.55, kCount, exact::log, logL, nearOne);
    checkUlp("log2", 0.55, kCount, exact::log2, log2L, positive);
    checkUlp("log2 near 1", 0.55, kCount, exact::log2, log2L, nearOne);
    CHECK_EQUAL(exact::exp(0.0), 1.0);
    CHECK_EQUAL(exact::exp(-kInfinity), 0.0);
    CHECK_EQUAL(exact::exp(kInfinity), kInfinity);
    CHECK_EQUAL(exact::exp(710.0), kInfinity);
    CHECK_EQUAL(exact::exp(-746.0), 0.0);
    CHECK(std::isnan(exact::exp(kNaN)));
    CHECK(std::isnan(exact::exp2(kNaN)));
    CHECK_EQUAL(exact::log(1.0), 0.0);
    CHECK_EQUAL(exact::log(0.0), -kInfinity);
    CHECK_EQUAL(exact::log(kInfinity), kInfinity);
    CHECK(std::isnan(exact::log(-1.0)));
    CHECK(std::isnan(exact::log(kNaN)));
    for (int k = -1074; k <= 1023; ++k) { // powers of two are exact both ways
        const double power = std::ldexp(1.0, k);
        CHECK_EQUAL(exact::exp2(k), power);
        CHECK_EQUAL(exact::log2(power), k);
    }
}

TEST(math_pow) {
    Draw draw;
    double y = 0;
    const auto power = [&](double x) { return exact::pow(x, y); };
    const auto powL = [&](long double x) { return std::pow(x, static_cast<long double>(y)); };
    // Any result that is a number: the exponent is drawn to fit the base.
    const auto anyResult = [&] {
        const double x = std::fabs(draw.spread(-1000, 1000));
        y = draw.uniform(-1000, 1000) / std::log2(x);
        return x;
    };
    checkUlp("pow", 0.55, kCount, power, powL, anyResult);
    // Specular lobes: cos in (0,1), exponents up to 1e5; results below 1e-300 do not matter.
    const auto lobe = [&] {
        y = std::fabs(draw.spread(0, 17));
        return exact::exp2(draw.uniform(-990, 0) / y);
    };
    checkUlp("pow lobe", 0.55, kCount, power, powL, lobe);
    const auto whole = [&] {
        y = std::floor(draw.uniform(-20, 20));
        return draw.uniform(-10, 10);
    };
    checkUlp("pow whole", 0.55, kCount, power, powL, whole);
    checkUlp(
        "cbrt", 0.7, kCount, exact::cbrt, [](long double x) { return std::cbrt(x); },
        [&] { return draw.spread(-1074, 1023); });
    for (int i = 1; i < 2000; ++i) CHECK_EQUAL(exact::cbrt(double(i) * i * i), i);

    // All pairs of special values agree with C99's annex F.
    const double values[] = {0.0, 0.5,  1.0,   1.5,       2.0,    3.0,
                             1e9, 1e16, 1e300, kInfinity, 5e-324, kNaN};
    for (const double a : values)
        for (const double b : values)
            for (const double x : {a, -a})
                for (const double exponent : {b, -b}) {
                    const double value = exact::pow(x, exponent), expected = std::pow(x, exponent);
                    const bool same =
                        std::isnan(expected)
                            ? std::isnan(value)
                            : !std::isnan(value) && std::signbit(value) == std::signbit(expected) &&
                                  (value == expected ||
                                   std::fabs(value - expected) <= 2e-16 * std::fabs(expected));
                    CHECK_INFO(same, "pow(" << x << ", " << exponent << ") = " << value
                                            << ", expected " << expected);
                }
    CHECK_EQUAL(exact::pow(3.0, 4.0), 81.0);
    CHECK_EQUAL(exact::pow(10.0, -2.0), 0.01);
}

TEST(math_pow_float) {
    Draw draw;
    int offByOne = 0;
    const int count = check::scaled(kCount);
    for (int i = 0; i < count; ++i) {
        const float exponent = static_cast<float>(std::fabs(draw.spread(-3, 17)));
        const float base = static_cast<float>(std::exp2(draw.uniform(-140, 120) / exponent));
        const float value = exact::pow(base, exponent);
        const float expected = static_cast<float>(
            std::pow(static_cast<long double>(base), static_cast<long double>(exponent)));
        if (value == expected) continue;
        ++offByOne;
        CHECK_INFO(value == nextUp(expected) || value == nextDown(expected),
                   base << "^" << exponent << " = " << value << ", expected " << expected);
    }
    CHECK_INFO(offByOne <= count / 10000, offByOne << " of " << count);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_EQUAL(exact::pow(0.0f, 0.0f), 1.0f);
    CHECK_EQUAL(exact::pow(0.0f, 5.0f), 0.0f);
    CHECK_EQUAL(exact::pow(1.0f, 1e30f), 1.0f);
    CHECK_EQUAL(exact::pow(0.999f, 3e38f), 0.0f);
    CHECK_EQUAL(exact::pow(1.001f, 3e38f), kInfinityF);
    CHECK_EQUAL(exact::pow(1e-45f, 1.0f), 1e-45f);
    CHECK_EQUAL(exact::pow(kInfinityF, 2.0f), kInfinityF);
    CHECK_EQUAL(exact::pow(0.5f, kInfinityF), 0.0f);
    CHECK(std::isnan(exact::pow(-1.0f, 2.0f)));
    CHECK(std::isnan(exact::pow(nan, 2.0f)));
    CHECK(std::isnan(exact::pow(2.0f, nan)));
}

// The values themselves, so that another machine or compiler that differs in one bit fails.
TEST(math_same_bits) {
    Draw draw;
    std::uint64_t hash = 1469598103934665603u;
    const auto add = [&](double value) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
    };
    for (int i = 0; i < 20000; ++i) {
        const double x = draw.uniform(-1, 1), y = draw.uniform(0, 100);
        add(exact::sin(y)), add(exact::cos(x * 1e6)), add(exact::tan(x)), add(exact::asin(x));
        add(exact::acos(x)), add(exact::atan2(x, y - 50)), add(exact::exp(y - 50));
        add(exact::log(y)), add(exact::pow(y, 10 * x)), add(exact::cbrt(x)), add(exact::exp2(x));
        add(static_cast<double>(exact::pow(static_cast<float>(y), static_cast<float>(10 * x))));
        add(exact::log2(y));
    }
    CHECK_EQUAL(hash, 11197553936877723781u);
}

TEST(math_helpers) {
    CHECK(std::isnan(min(1.0, kNaN))); // the second operand wins
    CHECK_EQUAL(min(kNaN, 1.0), 1.0);
    CHECK_EQUAL(max(kNaN, 1.0), 1.0);
    CHECK_EQUAL(clamp(kNaN, 2.0, 3.0), 2.0);
    CHECK_EQUAL(clamp(5.0f, 2.0f, 3.0f), 3.0f);
    CHECK_EQUAL(nextUp(1.0f), 1.0f + 0x1p-23f);
    CHECK_EQUAL(nextDown(1.0f), kOneMinusUlp);
    CHECK_EQUAL(nextUp(-0.0f), std::numeric_limits<float>::denorm_min());
    CHECK_EQUAL(nextDown(0.0), -std::numeric_limits<double>::denorm_min());
    CHECK_EQUAL(nextUp(std::numeric_limits<float>::max()), kInfinityF);
    CHECK_EQUAL(nextUp(kInfinity), kInfinity);
    CHECK_EQUAL(nextDown(kInfinity), std::numeric_limits<double>::max());
    CHECK_EQUAL(nextUp(-kInfinityF), -std::numeric_limits<float>::max());
    CHECK(std::isnan(nextUp(kNaN)));
    Draw draw;
    for (int i = 0; i < check::scaled(1000); ++i) {
        const double x = draw.spread(-140, 127);
        CHECK_EQUAL(nextUp(x), std::nextafter(x, kInfinity));
        CHECK_EQUAL(nextDown(x), std::nextafter(x, -kInfinity));
        const float below = floatBelow(x), above = floatAbove(x);
        CHECK(static_cast<double>(below) <= x && x <= static_cast<double>(above));
        CHECK(above == below || above == nextUp(below));
    }
    CHECK_EQUAL(floatBelow(1e300), std::numeric_limits<float>::max());
    CHECK_EQUAL(floatAbove(1e300), kInfinityF);
    CHECK_NEAR(roundingBound(5), 5 * 0x1p-24, 1e-12);
    CHECK(roundingBoundD(5) > 5 * 0x1p-53);
}

// Against exact integers: 60-bit products of 30-bit numbers, cancelling in the leading bits.
TEST(math_difference_of_products) {
    Draw draw;
    for (int i = 0; i < check::scaled(100000); ++i) {
        const auto whole = [&] { return static_cast<std::int64_t>(draw.engine() >> 34); };
        const std::int64_t a = whole() + 1, b = whole() + 1;
        const std::int64_t c = a + static_cast<std::int64_t>(draw.engine() % 7) - 3;
        const std::int64_t d = b + static_cast<std::int64_t>(draw.engine() % 7) - 3;
        const auto number = [](std::int64_t n) { return static_cast<double>(n); };
        const std::int64_t truth = a * b - c * d; // below 2^35, so exact as a double
        CHECK_EQUAL(differenceOfProducts(number(a), number(b), number(c), number(d)),
                    number(truth));
    }
    // Full 53-bit factors with little to no cancellation: rounded nearly once.
    __extension__ using Int128 = __int128;
    for (int i = 0; i < check::scaled(100000); ++i) {
        const auto factor = [&] { return static_cast<std::int64_t>(draw.engine() >> 11) | 1; };
        const std::int64_t a = factor(), b = factor(), d = factor();
        // Every other c makes the products cancel in their upper halves.
        const double close =
            static_cast<double>(a) * static_cast<double>(b) / static_cast<double>(d);
        if (close >= 0x1p53) continue;
        const std::int64_t c = i % 2 ? factor() : static_cast<std::int64_t>(close);
        const Int128 truth = Int128{a} * b - Int128{c} * d;
        const double value = differenceOfProducts(static_cast<double>(a), static_cast<double>(b),
                                                  static_cast<double>(c), static_cast<double>(d));
        const double error = static_cast<double>(static_cast<Int128>(value) - truth);
        CHECK_INFO(std::fabs(error) <= 0.501 * (nextUp(std::fabs(value)) - std::fabs(value)),
                   a << " " << b << " " << c << " " << d);
    }
    // (1+e)(1-e) - 1*1 = -e^2, which plain double gives as 0.
    CHECK_EQUAL(differenceOfProducts(1 + 0x1p-40, 1 - 0x1p-40, 1, 1), -0x1p-80);
}
