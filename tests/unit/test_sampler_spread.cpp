// How evenly samples are spread: cells, means, correlations, noise.
#include "base/math.h"
#include "check.h"
#include "sample/dimensions.h"
#include "unit/sampler_kit.h"

#include <cmath>
#include <set>

namespace test_sampler_spread {

using sampler_kit::fillsCells;
using sampler_kit::kKinds;
using sampler_kit::pairsOf;

namespace {

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    const double n = static_cast<double>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        sa += a[i], sb += b[i], saa += a[i] * a[i], sbb += b[i] * b[i], sab += a[i] * b[i];
    }
    return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

// Variance over pixels of the estimate of the quarter disk's area by `count` samples.
double diskVariance(SamplerKind kind, int count, std::uint32_t dimension) {
    const Sampler sampler(kind, count, 1);
    constexpr int kPixels = 4000;
    double sum = 0;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        int inside = 0;
        for (const Vec2 p : pairsOf(sampler, pixel, dimension, count))
            inside += p.x * p.x + p.y * p.y < 1;
        sum += sqr(static_cast<double>(inside) / count - kPi / 4);
    }
    return sum / kPixels;
}

} // namespace

// Owen-scrambled Sobol: every elementary interval of 2^k samples holds exactly one, in each pair
// of dimensions, and so does every later block of 2^k.
TEST(sampler_sobol_elementary_intervals) {
    for (const std::uint32_t dimension : {0u, 2u, 8u, 26u})
        for (std::uint32_t pixel = 0; pixel < 20; ++pixel)
            for (int k = 0; k <= 8; ++k) {
                const Sampler sampler(SamplerKind::Sobol, 1 << k, 5);
                for (const int block : {0, 3})
                    for (int i = 0; i <= k; ++i)
                        CHECK_INFO(
                            fillsCells(pairsOf(sampler, pixel, dimension, 1 << k, block << k),
                                       1 << i, 1 << (k - i)),
                            "dimension " << dimension << " pixel " << pixel << " 2^" << k
                                         << " block " << block << " columns 2^" << i);
            }
    const Sampler sampler(SamplerKind::Sobol, 4096, 5);
    for (int i = 0; i <= 12; ++i)
        CHECK(fillsCells(pairsOf(sampler, 7, 0, 4096), 1 << i, 1 << (12 - i)));
}

TEST(sampler_one_dimension_is_stratified) {
    for (const SamplerKind kind : {SamplerKind::Sobol, SamplerKind::Stratified, SamplerKind::Grid})
        for (const int count : {1, 2, 16, 64})
            for (std::uint32_t pixel = 0; pixel < 50; ++pixel)
                for (const int block : {0, 1, 2}) {
                    const Sampler sampler(kind, count, 9);
                    std::set<int> cells;
                    for (int i = 0; i < count; ++i)
                        cells.insert(static_cast<int>(
                            sampler.get1D(pixel, static_cast<std::uint32_t>(block * count + i),
                                          kTimeDimension) *
                            static_cast<float>(count)));
                    CHECK_EQUAL(std::ssize(cells), count);
                }
}

TEST(sampler_stratified_cells) {
    struct Case {
        int count, columns, rows;
    };
    for (const auto& [count, columns, rows] : {Case{1, 1, 1},
                                               {2, 2, 1},
                                               {4, 2, 2},
                                               {6, 3, 2},
                                               {7, 7, 1},
                                               {12, 4, 3},
                                               {16, 4, 4},
                                               {24, 6, 4},
                                               {100, 10, 10},
                                               {128, 16, 8}})
        for (const SamplerKind kind : {SamplerKind::Stratified, SamplerKind::Grid})
            for (const std::uint32_t dimension : {0u, 2u, 8u})
                for (std::uint32_t pixel = 0; pixel < 20; ++pixel)
                    for (const int block : {0, 1}) {
                        const Sampler sampler(kind, count, 2);
                        CHECK_INFO(
                            fillsCells(pairsOf(sampler, pixel, dimension, count, block * count),
                                       columns, rows),
                            count << " samples, dimension " << dimension);
                    }
    // Any count: the shuffle of the cells leaves none out.
    for (int count = 1; count < 300; ++count) {
        const Sampler sampler(SamplerKind::Stratified, count, 77);
        std::set<float> values;
        for (int i = 0; i < count; ++i)
            values.insert(std::floor(sampler.get1D(1, static_cast<std::uint32_t>(i), 4) *
                                     static_cast<float>(count)));
        CHECK_INFO(std::ssize(values) == count, count);
    }
}

// A light with 4 samples each: all 16 * 4 numbers of a pixel are stratified together.
TEST(sampler_streams) {
    for (const SamplerKind kind : {SamplerKind::Sobol, SamplerKind::Stratified}) {
        const Sampler sampler(kind, 16, 8);
        const Sampler light = sampler.stream(3, 4);
        CHECK_EQUAL(light.sampleCount(), 64);
        const std::uint32_t slot = dimension(2, BounceSlot::LightUv);
        for (std::uint32_t pixel = 0; pixel < 20; ++pixel)
            CHECK(fillsCells(pairsOf(light, pixel, slot, 64), 8, 8));
        // Other lights, and the sampler itself, give other numbers.
        CHECK(!(light.get2D(5, 0, slot) == sampler.stream(4, 4).get2D(5, 0, slot)));
        CHECK(!(light.get2D(5, 0, slot) == sampler.get2D(5, 0, slot)));
        CHECK(light.get2D(5, 0, slot) == sampler.stream(3, 4).get2D(5, 0, slot));
    }
    const Sampler one(SamplerKind::Sobol, 1, 8, false);
    CHECK(!(one.stream(0).get2D(0, 0, 0) == (Vec2{0.5f, 0.5f})));
}

// Sums over many pixels: the mean of u is 1/2, of u^2 1/3, and the 64 bins are even. 200,000
// numbers: sigma of the mean 6.5e-4, of a bin 56; the limits are 4 to 5 sigma of independent ones.
TEST(sampler_uniform) {
    for (const SamplerKind kind : kKinds)
        for (const std::uint32_t d : {0u, 1u, 4u, 13u}) {
            const Sampler sampler(kind, 4, 6);
            double sum = 0, squares = 0;
            std::vector<int> bins(64);
            for (std::uint32_t pixel = 0; pixel < 50000; ++pixel)
                for (std::uint32_t i = 0; i < 4; ++i) {
                    const Vec2 pair = sampler.get2D(pixel, i, d & ~1u);
                    const float u = d == 4 ? sampler.get1D(pixel, i, d) : d & 1 ? pair.y : pair.x;
                    sum += static_cast<double>(u);
                    squares += sqr(static_cast<double>(u));
                    ++bins[static_cast<std::size_t>(u * 64)];
                }
            CHECK_NEAR(sum / 200000, 0.5, 2.6e-3);
            CHECK_NEAR(squares / 200000, 1.0 / 3, 2.6e-3);
            for (const int n : bins) CHECK_NEAR(n, 200000.0 / 64, 280);
        }
}

// Dimensions, neighbouring pixels and seeds know nothing of each other. 100,000 pairs: sigma of
// the correlation 3.2e-3, limit 4.5 sigma over some 100 comparisons.
TEST(sampler_decorrelated) {
    const auto sequence = [](const Sampler& sampler, std::uint32_t shift, std::uint32_t d,
                             bool alone) {
        std::vector<double> out;
        for (std::uint32_t pixel = 0; pixel < 25000; ++pixel)
            for (std::uint32_t i = 0; i < 4; ++i) {
                const Vec2 pair = sampler.get2D(pixel + shift, i, d & ~1u);
                out.push_back(static_cast<double>(alone   ? sampler.get1D(pixel + shift, i, d)
                                                  : d & 1 ? pair.y
                                                          : pair.x));
            }
        return out;
    };
    for (const SamplerKind kind :
         {SamplerKind::Sobol, SamplerKind::Stratified, SamplerKind::Random}) {
        const Sampler sampler(kind, 4, 6);
        std::vector<std::vector<double>> all;
        for (const std::uint32_t d : {0u, 1u, 2u, 3u, 8u})
            all.push_back(sequence(sampler, 0, d, false));
        all.push_back(sequence(sampler, 0, 4, true));
        all.push_back(sequence(sampler, 0, 2, true));
        all.push_back(sequence(sampler, 1, 0, false));
        all.push_back(sequence(sampler, 1920, 0, false));
        all.push_back(sequence(Sampler(kind, 4, 7), 0, 0, false));
        all.push_back(sequence(sampler.stream(0, 1), 0, 0, false));
        all.push_back(sequence(sampler.stream(1, 1), 0, 0, false));
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                CHECK_INFO(std::fabs(correlation(all[i], all[j])) < 0.0145,
                           "kind " << static_cast<int>(kind) << " sequences " << i << " and " << j
                                   << ": " << correlation(all[i], all[j]));
    }
}

// What it is all for: less noise at the same number of samples.
TEST(sampler_variance) {
    // Independent samples: p (1 - p) / n.
    CHECK_NEAR(diskVariance(SamplerKind::Random, 16, 0) / (kPi / 4 * (1 - kPi / 4) / 16), 1, 0.1);
    for (const std::uint32_t dimension : {0u, 2u, 10u}) {
        const double random = diskVariance(SamplerKind::Random, 16, dimension);
        const double sobol = diskVariance(SamplerKind::Sobol, 16, dimension);
        const double cells = diskVariance(SamplerKind::Stratified, 16, dimension);
        CHECK_INFO(random > 3.2 * sobol, "random " << random << " sobol " << sobol);
        CHECK_INFO(random > 2.8 * cells, "random " << random << " stratified " << cells);
        // A full Owen scramble, bit by bit with independent coin flips, has 2.96e-3 (a separate
        // program, 1500 runs): the hash loses nothing.
        CHECK_NEAR(sobol, 2.96e-3, 0.25e-3);
        CHECK(diskVariance(SamplerKind::Random, 64, dimension) >
              6 * diskVariance(SamplerKind::Sobol, 64, dimension));
    }
    // An edge: variance falls faster than 1/n (n^-3/2), so 16 times the samples give over 40 times
    // less.
    CHECK(diskVariance(SamplerKind::Sobol, 16, 2) > 40 * diskVariance(SamplerKind::Sobol, 256, 2));
}

} // namespace test_sampler_spread
