#include "base/quadratic.h"
#include "check.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>

namespace {

struct Draw {
    std::mt19937_64 engine{7}; // the seed of all tests here
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
    std::int64_t whole(std::int64_t size) {
        return static_cast<std::int64_t>(engine() % static_cast<std::uint64_t>(2 * size + 1)) -
               size;
    }
};

double number(std::int64_t n) { return static_cast<double>(n); }
constexpr double kUlp = 0x1p-52;

} // namespace

// a (t - p)(t - q) with whole numbers: the coefficients are exact, so the roots are known.
TEST(quadratic_whole_roots) {
    Draw draw;
    for (int i = 0; i < check::scaled(200000); ++i) {
        const std::int64_t a = draw.whole(1000), p = draw.whole(1000000);
        // Every third pair of roots lies close together, where the discriminant cancels.
        const std::int64_t q = i % 3 ? draw.whole(1000000) : p + draw.whole(3);
        if (a == 0) continue;
        const Roots roots = solveQuadratic(number(a), number(-a * (p + q)), number(a * p * q));
        const double lo = number(std::min(p, q)), hi = number(std::max(p, q));
        CHECK_EQUAL(roots.count, p == q ? 1 : 2);
        CHECK_INFO(std::fabs(roots.t0 - lo) <= 4 * kUlp * std::fabs(lo) &&
                       std::fabs(roots.t1 - hi) <= 4 * kUlp * std::fabs(hi),
                   roots.t0 << " " << roots.t1 << ", expected " << lo << " " << hi);
    }
}

// The sign of the discriminant: whole coefficients below 2^29 make it exact in 64 bits.
TEST(quadratic_count) {
    Draw draw;
    for (int i = 0; i < check::scaled(200000); ++i) {
        const std::int64_t half = draw.whole(1 << 28), b = 2 * half;
        const std::int64_t a = half + draw.whole(2), c = half + draw.whole(2);
        if (a == 0) continue;
        const std::int64_t discriminant = half * half - a * c;
        const int expected = discriminant < 0 ? 0 : discriminant == 0 ? 1 : 2;
        const Roots roots = solveQuadratic(number(a), number(b), number(c));
        CHECK_INFO(roots.count == expected, a << " " << b << " " << c << ": " << roots.count);
        CHECK(roots.t0 <= roots.t1);
    }
}

// The nearer hit on a sphere of 1e9 from just outside it.
TEST(quadratic_small_root_of_a_large_pair) {
    const Roots roots = solveQuadratic(1, -1e9, 1); // t = 1e-9 (1 + 1e-18), which cancels naively
    CHECK_EQUAL(roots.count, 2);
    CHECK_NEAR(roots.t0, 1e-9, 4e-25);
    CHECK_NEAR(roots.t1, 1e9, 2e-7);
}

TEST(quadratic_special) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(solveQuadratic(1, 0, 1) == Roots{});
    CHECK((solveQuadratic(1, 0, 0) == Roots{1, 0, 0}));
    CHECK((solveQuadratic(1, 0, -4) == Roots{2, -2, 2}));
    CHECK((solveQuadratic(-1, 0, 4) == Roots{2, -2, 2}));
    CHECK((solveQuadratic(2, -4, 2) == Roots{1, 1, 1}));
    CHECK((solveQuadratic(1, -3, 0) == Roots{2, 0, 3}));
    CHECK((solveQuadratic(0, 2, -6) == Roots{1, 3, 3}));
    CHECK(solveQuadratic(0, 0, 0) == Roots{});
    CHECK(solveQuadratic(0, 0, 1) == Roots{});
    CHECK(solveQuadratic(nan, 1, 1) == Roots{});
    CHECK(solveQuadratic(1, nan, 1) == Roots{});
    CHECK(solveQuadratic(1, 1, nan) == Roots{});
    CHECK(solveQuadratic(kInfinity, 1, -1) == Roots{});
    CHECK(solveQuadratic(1, kInfinity, -1) == Roots{});
}

// Nearly parabolic, and coefficients whose squares leave the range of double.
TEST(quadratic_extremes) {
    const Roots parabola = solveQuadratic(1e-300, 1, -2); // roots 2 and -1e300
    CHECK_EQUAL(parabola.count, 2);
    CHECK_NEAR(parabola.t1, 2, 1e-15);
    CHECK_NEAR(parabola.t0 / -1e300, 1, 1e-15);
    const Roots outside = solveQuadratic(1e-320, 1, -2); // the far root is beyond double
    CHECK((outside == Roots{1, 2, 2}));
    Draw draw;
    for (int i = 0; i < check::scaled(10000); ++i) {
        // Scaling all coefficients by 2^k, and t by 2^m, must not change the bits.
        const double a = draw.uniform(-1, 1), b = draw.uniform(-4, 4), c = draw.uniform(-1, 1);
        if (a == 0) continue;
        const Roots plain = solveQuadratic(a, b, c);
        const int k = static_cast<int>(draw.whole(700)), m = static_cast<int>(draw.whole(250));
        const Roots scaled =
            solveQuadratic(std::ldexp(a, k - m), std::ldexp(b, k), std::ldexp(c, k + m));
        CHECK_EQUAL(scaled.count, plain.count);
        CHECK_EQUAL(std::ldexp(scaled.t0, -m), plain.t0);
        CHECK_EQUAL(std::ldexp(scaled.t1, -m), plain.t1);
    }
}
