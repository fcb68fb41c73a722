// Exponentials, logarithms and powers against long double.
#include "base/math.h"
#include "check.h"
#include "unit/math_kit.h"

#include <cmath>
#include <limits>

namespace test_math_powers {

using math_kit::checkUlp;
using math_kit::Draw;
using math_kit::kCount;
using math_kit::kNaN;

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
        float exponent = static_cast<float>(std::fabs(draw.spread(-3, 17)));
        if (i % 2 == 0) exponent = std::ceil(exponent); // up to kMostSquared by squares
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
    CHECK_EQUAL(exact::pow(0x1p-149f, 1024.0f), 0.0f);
    CHECK_EQUAL(exact::pow(0x1p+127f, 1024.0f), kInfinityF);
    CHECK_EQUAL(exact::pow(0.5f, 149.0f), 0x1p-149f);
    CHECK_EQUAL(exact::pow(0.5f, 150.0f), 0.0f); // to even
    CHECK_EQUAL(exact::pow(0.999f, 3e38f), 0.0f);
    CHECK_EQUAL(exact::pow(1.001f, 3e38f), kInfinityF);
    CHECK_EQUAL(exact::pow(1e-45f, 1.0f), 1e-45f);
    CHECK_EQUAL(exact::pow(kInfinityF, 2.0f), kInfinityF);
    CHECK_EQUAL(exact::pow(0.5f, kInfinityF), 0.0f);
    CHECK(std::isnan(exact::pow(-1.0f, 2.0f)));
    CHECK(std::isnan(exact::pow(nan, 2.0f)));
    CHECK(std::isnan(exact::pow(2.0f, nan)));
}

} // namespace test_math_powers
