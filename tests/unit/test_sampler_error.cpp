// How good samples are: their discrepancy, and how fast errors fall with their number.
#include "base/math.h"
#include "check.h"
#include "sample/hash.h"
#include "unit/sampler_kit.h"

#include <cmath>

namespace test_sampler_error {

using sampler_kit::pairsOf;

namespace {

// The square of the L2 star discrepancy (Warnock 1972), the mean over pixels.
double squaredDiscrepancy(SamplerKind kind, int count, std::uint32_t dimension) {
    constexpr std::uint32_t kPixels = 40;
    const Sampler sampler(kind, count, 3);
    const double n = count;
    double mean = 0;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        const std::vector<Vec2> points = pairsOf(sampler, pixel, dimension, count);
        double single = 0, both = 0;
        for (const Vec2 p : points) {
            const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
            single += (1 - x * x) * (1 - y * y);
            for (const Vec2 q : points)
                both += (1 - std::fmax(x, static_cast<double>(q.x))) *
                        (1 - std::fmax(y, static_cast<double>(q.y)));
        }
        mean += (1.0 / 9 - single / (2 * n) + both / (n * n)) / kPixels;
    }
    return mean;
}

// The slope of the logarithm of the variance over that of the number of samples, from 16 to 1024.
template <class Fn>
double slope(SamplerKind kind, std::uint32_t dimension, double truth, const Fn& integrand) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0, n = 0;
    for (int k = 4; k <= 10; ++k, ++n) {
        const Sampler sampler(kind, 1 << k, 9);
        constexpr std::uint32_t kPixels = 400;
        double variance = 0;
        for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
            double sum = 0;
            for (const Vec2 p : pairsOf(sampler, pixel, dimension, 1 << k))
                sum += integrand(static_cast<double>(p.x), static_cast<double>(p.y));
            variance += sqr(sum / (1 << k) - truth) / kPixels;
        }
        const double x = k, y = std::log2(variance);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

} // namespace

// Independent points: (1/4 - 1/9) / n.
TEST(sampler_discrepancy_is_far_below_that_of_random) {
    for (const std::uint32_t dimension : {0u, 8u, 26u, 70u})
        for (const int count : {16, 64, 256}) {
            const double expected = (1.0 / 4 - 1.0 / 9) / count;
            CHECK_NEAR(squaredDiscrepancy(SamplerKind::Random, count, dimension) / expected, 1,
                       0.35);
            const double least = count == 16 ? 6 : count == 64 ? 18 : 50;
            for (const SamplerKind kind : {SamplerKind::Sobol, SamplerKind::ZSobol}) {
                const double square = squaredDiscrepancy(kind, count, dimension);
                CHECK_INFO(expected > least * square, "kind " << static_cast<int>(kind) << ", "
                                                              << count << " samples: below by "
                                                              << expected / square);
            }
        }
}

TEST(sampler_variance_falls_as_it_should) {
    const auto smooth = [](double x, double y) { return x * x * y + 0.5 * x; };
    const auto edge = [](double x, double y) { return x + 0.6 * y < 0.9 ? 1.0 : 0.0; };
    // White noise in the square has no neighbours that samples could be spread for.
    const auto noise = [](double x, double y) {
        const auto bits = [](double u) { return static_cast<std::uint32_t>(u * 0x1p24); };
        return static_cast<double>(unitFloat(low32(hash(bits(x), bits(y)))));
    };
    for (const std::uint32_t dimension : {0u, 8u, 70u}) {
        const auto isIn = [&](const char* name, double value, double from, double to) {
            CHECK_INFO(value > from && value < to, name << ", dimension " << dimension
                                                        << ": slope " << value << ", not from "
                                                        << from << " to " << to);
        };
        for (const SamplerKind kind : {SamplerKind::Sobol, SamplerKind::ZSobol}) {
            isIn("smooth", slope(kind, dimension, 1.0 / 6 + 0.25, smooth), -3.2, -2.2);
            isIn("edge", slope(kind, dimension, 0.6, edge), -1.7, -1.3);
            isIn("noise", slope(kind, dimension, 0.5, noise), -1.12, -0.88);
        }
        isIn("random numbers", slope(SamplerKind::Random, dimension, 1.0 / 6 + 0.25, smooth),
             -1.12, -0.88);
    }
}

} // namespace test_sampler_error
