#include "base/quadratic.h"
#include "check.h"
#include "verify/groups.h"

#include <cstdint>
#include <limits>
#include <random>

namespace test_quadratic {

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

} // namespace

// Random, clustered and whole roots: the row of the battery (Code/verify/solvers.cpp).
TEST(quadratic_against_113_bits) {
    for (const battery::Row& row : battery::solverRows()) {
        const battery::Tally tally = row.run({check::scaled(1.0), 1});
        CHECK_INFO(battery::passed(row, tally), row.id << ": " << tally.failedCase << "; "
                                                       << tally.worst << " " << tally.worstCase);
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

} // namespace test_quadratic
