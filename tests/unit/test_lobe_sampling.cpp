// Sampled directions of lobes are distributed by pdf(), and their weights are eval() / pdf().
#include "check.h"
#include "unit/lobe_kit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace test_lobe_sampling {

namespace {

using namespace lobe_kit;

constexpr unsigned kSeed = 51;

// A sampled direction in terms of z and phi, by the numbers that pdf() gets.
struct Drawn {
    double z, phi; // phi from 0 to 2 pi, pi away from the eye
};

struct Samples {
    std::vector<Drawn> drawn;
    int count = 0, lost = 0;
};

template <class L> Samples samplesOf(const L& lobe, const Floats3& toEye, int count,
                                     std::mt19937_64& random) {
    Samples samples{{}, count, 0};
    const auto next = [&] { return Floats(static_cast<float>(random() >> 40) * 0x1p-24f); };
    for (int i = 0; i < count; ++i) {
        const Floats pick = next(), u = next(), v = next();
        const LobeSample s = lobe.sample(toEye, pick, u, v);
        if (!(s.pdf.v > 0)) {
            ++samples.lost;
            continue;
        }
        const double phi = std::atan2(static_cast<double>(s.toLight.y.v),
                                      static_cast<double>(s.toLight.x.v));
        samples.drawn.push_back({static_cast<double>(s.toLight.z.v), phi < 0 ? phi + 2 * kPi : phi});
    }
    return samples;
}

// Borders between parts that get about as many of these numbers each.
std::vector<double> bordersOf(std::vector<double> numbers, std::size_t parts, double from,
                              double to) {
    std::sort(numbers.begin(), numbers.end());
    std::vector<double> borders{from};
    for (std::size_t i = 1; i < parts && !numbers.empty(); ++i) {
        const double border = numbers[numbers.size() * i / parts];
        if (border > borders.back() && border < to) borders.push_back(border);
    }
    borders.push_back(to);
    return borders;
}

// How many normal deviations the chi-square statistic of these counts is above its mean, by the cube
// root of Wilson and Hilferty 1931. Bins that expect less than 5 are taken together.
double deviationOf(const std::vector<double>& expected, const std::vector<double>& counts) {
    double sum = 0, restExpected = 0, restCount = 0;
    int bins = 0;
    const auto add = [&](double e, double n) { sum += (n - e) * (n - e) / e, ++bins; };
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (expected[i] >= 5)
            add(expected[i], counts[i]);
        else
            restExpected += expected[i], restCount += counts[i];
    if (restExpected >= 5)
        add(restExpected, restCount);
    else if (restCount > restExpected + 20) // by Poisson's law below 1e-7
        return 100;
    if (bins < 2) return 0;
    const double freedom = bins - 1, a = 2 / (9 * freedom);
    return (std::cbrt(sum / freedom) - (1 - a)) / std::sqrt(a);
}

struct Result {
    double deviation = 0, total = 0;
};
template <class L>
Result chiSquare(const L& lobe, const Case& c, double cosEye, std::mt19937_64& random) {
    const Floats3 toEye = direction(cosEye, 0);
    constexpr std::size_t kHeights = 10, kTurns = 8;
    const Samples pilot = samplesOf(lobe, toEye, 1000, random);
    std::vector<double> z, phi;
    for (const Drawn& d : pilot.drawn) z.push_back(d.z), phi.push_back(d.phi);
    std::vector<double> heights = bordersOf(z, kHeights, -1, 1);
    const std::vector<double> turns = bordersOf(phi, kTurns, 0, 2 * kPi);
    if (std::find(heights.begin(), heights.end(), 0) == heights.end())
        heights.insert(std::lower_bound(heights.begin(), heights.end(), 0), 0);

    const auto f = [&](double height, double turn) {
        return static_cast<double>(lobe.pdf(toEye, direction(height, turn)).v);
    };
    const auto peaks = peaksOf(c, cosEye);
    const Integral integral(f, 2e-6, peaks);
    const Samples samples = samplesOf(lobe, toEye, 4000, random);
    std::vector<double> expected, counts;
    const std::size_t columns = turns.size() - 1;
    double total = 0;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            // Quarters at least, so that narrow strips are seen.
            const double middle = 0.5 * (turns[j] + turns[j + 1]);
            const double part = integral.over(heights[i], heights[i + 1], turns[j], middle) +
                                integral.over(heights[i], heights[i + 1], middle, turns[j + 1]);
            total += part;
            expected.push_back(part * samples.count);
        }
    expected.push_back(std::max(1 - total, 0.0) * samples.count);
    counts.assign(expected.size(), 0);
    counts.back() = samples.lost;
    for (const Drawn& d : samples.drawn) {
        const auto in = [](const std::vector<double>& borders, double x) {
            const auto at = std::upper_bound(borders.begin() + 1, borders.end() - 1, x);
            return static_cast<std::size_t>(at - borders.begin()) - 1;
        };
        ++counts[in(heights, d.z) * columns + in(turns, d.phi)];
    }
    return {deviationOf(expected, counts), total};
}

constexpr double kCosines[] = {0.1, 0.6, 0.95};

} // namespace

// The level 1e-4 for all together is 1e-4 / 400 for each of about 400 (Sidak), 5.03 deviations.
TEST(lobe_sampling_chi_square) {
    std::mt19937_64 random(kSeed);
    int tests = 0;
    double largest = 0;
    for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind)
        for (const Case& c : casesOf(kind)) {
            if (!c.has(kSpawnsRays | kAnswersLights)) continue;
            for (const double cosEye : kCosines)
                with(c, [&](const auto& lobe) {
                    if constexpr (requires { lobe.pdf(Floats3{}, Floats3{}); }) {
                        const Result r = chiSquare(lobe, c, cosEye, random);
                        largest = std::max(largest, r.deviation), ++tests;
                        CHECK_INFO(r.deviation < 5.03, shown(c) << " cos " << cosEye << ": "
                                                                << r.deviation << ", pdf sums up to "
                                                                << r.total << ", seed " << kSeed);
                        CHECK_INFO(r.total < 1 + 1e-3,
                                   shown(c) << " cos " << cosEye << ": " << r.total);
                    }
                });
        }
    CHECK(tests > 300 && tests <= 400);
    std::printf("%d chi-square tests, the largest %.2f deviations, seed %u\n", tests, largest,
                kSeed);
}

} // namespace test_lobe_sampling
