// The sampler ZSobol: one sequence along the Z-order of the pixels, whose errors are finer than
// those of independent pixels.
#include "base/math.h"
#include "check.h"
#include "sample/dimensions.h"
#include "sample/zsobol.h"
#include "unit/sampler_kit.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

namespace test_zsobol {

using namespace kernels::one;
using sampler_kit::fillsCells;
using sampler_kit::pairsOf;

namespace {

constexpr std::uint32_t kSide = 64;

// By row, the errors of the mean of an integrand over the samples of each pixel of a square.
template <class Fn>
std::vector<double> errorPicture(const Sampler& sampler, std::uint32_t dimension, double truth,
                                 const Fn& integrand) {
    std::vector<double> errors;
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            double sum = 0;
            for (const Vec2 p : pairsOf(sampler, zNumber(x, y), dimension, sampler.sampleCount()))
                sum += integrand(static_cast<double>(p.x), static_cast<double>(p.y));
            errors.push_back(sum / sampler.sampleCount() - truth);
        }
    return errors;
}

// The power below a quarter of Nyquist's frequency, as a share of what white noise of that many
// pixels has there at an error of 1.
double lowPower(const std::vector<double>& errors) {
    constexpr int kMost = kSide / 8;
    std::array<double, kSide> cosines{}, sines{};
    for (std::uint32_t i = 0; i < kSide; ++i) {
        cosines[i] = std::cos(2 * kPi * i / kSide);
        sines[i] = std::sin(2 * kPi * i / kSide);
    }
    double power = 0;
    int frequencies = 0;
    for (int v = -kMost; v <= kMost; ++v)
        for (int u = -kMost; u <= kMost; ++u) {
            if (u * u + v * v >= kMost * kMost) continue;
            double real = 0, imaginary = 0;
            for (std::uint32_t i = 0; i < errors.size(); ++i) {
                const std::uint32_t phase = (static_cast<std::uint32_t>(u) * (i % kSide) +
                                             static_cast<std::uint32_t>(v) * (i / kSide)) %
                                            kSide;
                real += errors[i] * cosines[phase], imaginary += errors[i] * sines[phase];
            }
            power += sqr(real) + sqr(imaginary);
            ++frequencies;
        }
    return power / (static_cast<double>(errors.size()) * frequencies);
}

double meanSquare(const std::vector<double>& errors) {
    double sum = 0;
    for (const double e : errors) sum += sqr(e);
    return sum / static_cast<double>(errors.size());
}

} // namespace

TEST(zsobol_permutes_digits_in_all_ways) {
    std::map<std::uint32_t, int> seen;
    constexpr int kCount = 24000;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const std::uint32_t hash = mixed32(i);
        std::uint32_t order = 0, digits = 0;
        for (std::uint32_t digit = 0; digit < 4; ++digit) {
            const std::uint32_t to = permutedDigit(digit, hash);
            order = 4 * order + to, digits |= 1u << to;
        }
        CHECK_EQUAL(digits, 15u);
        ++seen[order];
    }
    CHECK_EQUAL(seen.size(), 24u);
    for (const auto& [order, count] : seen) CHECK_NEAR(count, 1000, 150);
}

TEST(zsobol_numbers_all_samples_once) {
    for (const int bits : {0, 1, 2, 5}) {
        const Sampler sampler(SamplerKind::ZSobol, 1 << bits, 3);
        CHECK_EQUAL(sampler.sampleBits(), bits);
        std::set<std::uint32_t> seen;
        for (std::uint32_t y = 0; y < kSide; ++y)
            for (std::uint32_t x = 0; x < kSide; ++x) {
                const std::uint32_t first = sampler.pairSeeds(zNumber(x, y), 2).index;
                CHECK_EQUAL(first & ((1u << bits) - 1), 0u);
                seen.insert(first);
                // A square of pixels is a part of the sequence in one piece.
                CHECK_EQUAL(first >> (bits + 4),
                            sampler.pairSeeds(zNumber(x & ~3u, y & ~3u), 2).index >> (bits + 4));
            }
        CHECK_EQUAL(seen.size(), std::size_t{kSide} * kSide);
    }
}

// A pixel's samples fill the cells of every shape, and so do those of squares of pixels.
TEST(zsobol_pixels_and_squares_are_nets) {
    for (const std::uint32_t dimension : {0u, 2u, 26u})
        for (const int k : {0, 1, 2, 4, 5}) {
            const Sampler sampler(SamplerKind::ZSobol, 1 << k, 5);
            for (std::uint32_t pixel = 0; pixel < 40; ++pixel)
                for (int i = 0; i <= k; ++i)
                    CHECK(fillsCells(pairsOf(sampler, pixel, dimension, 1 << k), 1 << i,
                                     1 << (k - i)));
            for (std::uint32_t square = 0; square < 4; ++square) {
                std::vector<Vec2> all;
                for (std::uint32_t pixel = 0; pixel < 16; ++pixel)
                    for (const Vec2 p : pairsOf(sampler, 16 * square + pixel, dimension, 1 << k))
                        all.push_back(p);
                for (int i = 0; i <= k + 4; ++i)
                    CHECK(fillsCells(all, 1 << i, 1 << (k + 4 - i)));
            }
        }
}

// What pixels have in common moves error to high frequencies, and makes neither more of it nor
// another mean.
TEST(zsobol_noise_is_finer_than_of_sobol) {
    const auto edge = [](double x, double y) { return x + 0.6 * y < 0.9 ? 1.0 : 0.0; };
    const auto gradient = [](double x, double y) { return x * y; };
    const auto compare = [](const char* name, double truth, const auto& integrand) {
        for (const int samples : {1, 4}) {
            double low[2] = {}, all[2] = {}, mean[2] = {};
            for (std::uint32_t seed = 0; seed < 6; ++seed)
                for (const std::size_t isZ : {0u, 1u}) {
                    const Sampler sampler(isZ ? SamplerKind::ZSobol : SamplerKind::Sobol, samples,
                                          seed);
                    const auto errors = errorPicture(sampler, 8, truth, integrand);
                    low[isZ] += lowPower(errors) / 6, all[isZ] += meanSquare(errors) / 6;
                    for (const double e : errors)
                        mean[isZ] += e / static_cast<double>(6 * errors.size());
                }
            CHECK_INFO(low[1] < 0.5 * low[0], name << ", " << samples << " samples: low power "
                                                   << low[1] << " of " << low[0]);
            CHECK_NEAR(low[0] / all[0], 1, 0.15); // independent pixels: white noise
            CHECK_NEAR(all[1] / all[0], 1, 0.1);
            CHECK_NEAR(mean[1], 0, 1e-3);
        }
    };
    compare("edge", 0.6, edge);
    compare("gradient", 0.25, gradient);
}

// Pairs of one sample, of which the upper bits would be the same if all pixels took their samples
// in one order.
TEST(zsobol_dimensions_are_independent) {
    const Sampler sampler(SamplerKind::ZSobol, 4, 7);
    std::array<int, 16> cells{};
    for (std::uint32_t pixel = 0; pixel < 4096; ++pixel)
        for (std::uint32_t sample = 0; sample < 4; ++sample) {
            const Vec2 a = sampler.get2D(pixel, sample, 0), b = sampler.get2D(pixel, sample, 8);
            const auto at = [](float u) { return u >= 0.5f ? 1u : 0u; };
            ++cells[at(a.x) + 2 * at(a.y) + 4 * at(b.x) + 8 * at(b.y)];
        }
    for (const int count : cells) CHECK_NEAR(count, 1024, 130); // 4 sigma
}

} // namespace test_zsobol
