// The bits of the elementary functions, and the helpers beside them.
#include "base/math.h"
#include "check.h"
#include "unit/math_kit.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace test_math {

using math_kit::Draw;
using math_kit::kNaN;

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

} // namespace test_math
