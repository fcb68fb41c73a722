// Sine, cosine, tangent and their inverses against long double.
#include "base/math.h"
#include "check.h"
#include "unit/math_kit.h"

#include <cmath>
#include <limits>

namespace test_math_angles {

using math_kit::checkUlp;
using math_kit::Draw;
using math_kit::kCount;
using math_kit::kNaN;

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

} // namespace test_math_angles
