#include "base/math.h"
#include "check.h"
#include "sample/filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_filter {

namespace {

constexpr FilterKind kKinds[] = {FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian,
                                 FilterKind::BlackmanHarris};

} // namespace

// The placed samples have the filter's density: their share left of any offset is the integral of
// value() up to it, here by the midpoint rule with 20,000 steps.
TEST(filter_density) {
    for (const FilterKind kind : kKinds)
        for (const double width : {0.5, 1.5, 4.0}) {
            const Filter filter(kind, width);
            constexpr int kSteps = 20000;
            std::vector<double> cdf{0};
            for (int i = 0; i < kSteps; ++i)
                cdf.push_back(cdf.back() +
                              filter.value(filter.radius() * (2 * (i + 0.5) / kSteps - 1)));
            for (int i = 0; i < 2000; ++i) {
                const float u = (static_cast<float>(i) + 0.5f) / 2000;
                const double x = static_cast<double>(filter.sample({u, 0.5f}).x) / filter.radius();
                const double place = (x + 1) / 2 * kSteps;
                const auto below = static_cast<std::size_t>(place);
                const double share = lerp(cdf[below], cdf[std::min<std::size_t>(below + 1, kSteps)],
                                          place - static_cast<double>(below)) /
                                     cdf.back();
                CHECK_INFO(std::fabs(share - static_cast<double>(u)) < 2e-6,
                           "kind " << static_cast<int>(kind) << " u " << u << " share " << share);
            }
        }
}

// The table of each smooth filter against the closed forms of its integral: what lies between an
// entry and the centre is the share that it stands for, to half the last bit of the entry (and a
// fiftieth for what the closed forms round).
TEST(filter_tables_are_right_to_the_last_bit) {
    const auto blackmanHarris = [](double x) {
        const auto term = [x](double weight, int k) {
            return weight * std::sin(k * kPi * x) / (k * kPi);
        };
        return 0.35875 * x + term(0.48829, 1) + term(0.14128, 2) + term(0.01168, 3);
    };
    const auto gaussian = [](double x) {
        return 0.5 * std::sqrt(kPi / 18) * std::erf(std::sqrt(18.0) * x);
    };
    const auto check = [](FilterKind kind, const auto& integral) {
        const Filter filter(kind, 1.5);
        const float* const table = filter.spread().inverse;
        CHECK_EQUAL(table[0], 1.0f);
        CHECK_EQUAL(table[Filter::kSteps], 0.0f);
        for (int i = 1; i < Filter::kSteps; ++i) {
            const float entry = table[i];
            const double x = static_cast<double>(entry);
            const double wanted = 1 - sqr(static_cast<double>(i) / Filter::kSteps);
            const double lastBit = static_cast<double>(std::nextafter(entry, 2.0f)) - x;
            const double off = (integral(x) - wanted * integral(1)) / // in x
                               filter.value(x * filter.radius());
            CHECK_INFO(std::fabs(off) <= 0.52 * lastBit, "kind " << static_cast<int>(kind)
                                                                 << " entry " << i << " off by "
                                                                 << off / lastBit << " last bits");
        }
    };
    check(FilterKind::BlackmanHarris, blackmanHarris);
    check(FilterKind::Gaussian, gaussian);
}

TEST(filter_symmetric_and_monotone) {
    for (const FilterKind kind : kKinds) {
        const Filter filter(kind, 1.5);
        CHECK(filter.sample({0.5f, 0.5f}) == Vec2{});
        float before = -10;
        for (int i = 0; i < 4096; ++i) {
            const float u = static_cast<float>(i) / 4096;
            const Vec2 p = filter.sample({u, u});
            CHECK_EQUAL(p.x, p.y);
            CHECK(p.x > before);
            CHECK(std::fabs(static_cast<double>(p.x)) <= filter.radius());
            if (i > 0) CHECK_EQUAL(filter.sample({1 - u, 0}).x, -p.x);
            before = p.x;
        }
        CHECK_NEAR(filter.sample({0, kOneMinusUlp}).x, -filter.radius(), 1e-6);
        CHECK(static_cast<double>(filter.sample({kOneMinusUlp, 0}).x) <= filter.radius());
    }
}

// Closed forms: mean square offset of one axis in units of the width (1/12, 1/24, sigma^2 = 1/16
// but for the cut at 6 sigma; Blackman-Harris by its cosine terms).
TEST(filter_spread) {
    const auto meanSquare = [](FilterKind kind) {
        const Filter filter(kind, 2);
        double sum = 0;
        constexpr int kCount = 100000;
        for (int i = 0; i < kCount; ++i)
            sum += sqr(
                static_cast<double>(filter.sample({(static_cast<float>(i) + 0.5f) / kCount, 0}).x));
        return sum / kCount / 4;
    };
    CHECK_NEAR(meanSquare(FilterKind::Box), 1.0 / 12, 1e-6);
    CHECK_NEAR(meanSquare(FilterKind::Tent), 1.0 / 24, 1e-6);
    CHECK_NEAR(meanSquare(FilterKind::Gaussian), 1.0 / 16, 1e-6);
    // Integral of x^2 cos(pi k (x+1)) over [-1,1] is 4 / (pi k)^2, of 1 it is 2/3; the mass 2 a0.
    const double blackman = (0.35875 * 2 / 3 - 0.48829 * 4 / sqr(kPi) + 0.14128 * 4 / sqr(2 * kPi) -
                             0.01168 * 4 / sqr(3 * kPi)) /
                            (2 * 0.35875);
    CHECK_NEAR(meanSquare(FilterKind::BlackmanHarris), blackman, 1e-6);
}

TEST(filter_reach) {
    CHECK_EQUAL(Filter(FilterKind::Box, 1).radius(), 0.5);
    CHECK_EQUAL(Filter(FilterKind::BlackmanHarris, 1.5).radius(), 1.5);
    CHECK_EQUAL(Filter(FilterKind::Box, 1).sample({0, 0.75f}).x, -0.5f);
    CHECK_EQUAL(Filter(FilterKind::Box, 1).sample({0, 0.75f}).y, 0.25f);
    for (const FilterKind kind : kKinds) {
        CHECK(Filter(kind, 0).sample({0.1f, 0.9f}) == Vec2{});
        CHECK_EQUAL(Filter(kind, 1).value(2), 0.0);
        CHECK_NEAR(Filter(kind, 1).value(0), 1, 1e-12);
    }
}

} // namespace test_filter
