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

template <class L>
Samples samplesOf(const L& lobe, const Floats3& toEye, int count, std::mt19937_64& random) {
    Samples samples{{}, count, 0};
    const auto next = [&] { return Floats(static_cast<float>(random() >> 40) * 0x1p-24f); };
    for (int i = 0; i < count; ++i) {
        const Floats pick = next(), u = next(), v = next();
        const LobeSample s = lobe.sample(toEye, pick, u, v);
        if (!(s.pdf.v > 0)) {
            ++samples.lost;
            continue;
        }
        const double phi =
            std::atan2(static_cast<double>(s.toLight.y.v), static_cast<double>(s.toLight.x.v));
        samples.drawn.push_back(
            {static_cast<double>(s.toLight.z.v), phi < 0 ? phi + 2 * kPi : phi});
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

// How many normal deviations the chi-square statistic of these counts is above its mean, by the
// cube root of Wilson and Hilferty 1931. Bins that expect less than 5 are taken together.
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

// Of a kind, and for facets some that are wider along one axis.
std::vector<Case> allCasesOf(std::uint32_t kind) {
    std::vector<Case> all = casesOf(kind);
    Case turned = whiteCase(kind);
    if (float* const anisotropy = turned.number("anisotropy"))
        for (const float a : {-0.6f, 0.9f}) {
            *anisotropy = a, *turned.number("roughness") = 0.5f;
            if (float* const rotation = turned.number("rotation")) *rotation = 0.1f;
            turned.eta = 1.5f, turned.width = 0.25f * std::sqrt(1 - 0.9f * std::fabs(a));
            all.push_back(turned);
        }
    return all;
}

// Any numbers that scenes may have, a roughness often 0, and any direction of the eye.
class Draw {
public:
    float unit() { return static_cast<float>(random_() >> 40) * 0x1p-24f; }
    Case lobe(std::uint32_t kind) {
        Case c{kind};
        std::size_t at = 0;
        for (const LobeField& field : c.type().fields)
            for (int i = 0; i < field.count; ++i)
                c.numbers[at++] =
                    field.least + unit() * (std::min(field.most, 100.0f) - field.least);
        if (float* const roughness = c.number("roughness"))
            *roughness = unit() < 0.2f ? 0 : 0.03f + 0.97f * unit();
        if (float* const exponent = c.number("exponent")) *exponent *= unit();
        if (float* const ior = c.number("ior")) *ior = 1 + 2 * unit();
        c.eta = unit() < 0.5f ? 1 + 2 * unit() : 1 / (1 + 2 * unit());
        return c;
    }
    Floats3 toEye() { return direction(1e-3 + 0.999 * static_cast<double>(unit()), 2 * kPi * unit()); }

private:
    std::mt19937_64 random_{kSeed};
};

bool isNear(const Floats3& a, const Floats3& b, float relative) {
    const auto near = [&](float x, float y) {
        return std::fabs(x - y) <= relative * std::max(std::fabs(x), std::fabs(y));
    };
    return near(a.x.v, b.x.v) && near(a.y.v, b.y.v) && near(a.z.v, b.z.v);
}
std::string shown(const Floats3& a) {
    std::ostringstream out;
    out << a.x.v << " " << a.y.v << " " << a.z.v;
    return out.str();
}

} // namespace

// The level 1e-4 for all together is 1e-4 / 400 for each of at most 400 (Sidak), 5.03 deviations.
TEST(lobe_sampling_chi_square) {
    std::mt19937_64 random(kSeed);
    int tests = 0;
    double largest = 0;
    for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind)
        for (const Case& c : allCasesOf(kind)) {
            if (!c.has(kSpawnsRays | kAnswersLights)) continue;
            for (const double cosEye : kCosines)
                with(c, [&](const auto& lobe) {
                    if constexpr (requires { lobe.pdf(Floats3{}, Floats3{}); }) {
                        const Result r = chiSquare(lobe, c, cosEye, random);
                        largest = std::max(largest, r.deviation), ++tests;
                        const auto where = lobe_kit::shown(c) + " cos " + std::to_string(cosEye);
                        CHECK_INFO(r.deviation < 5.03, where << ": " << r.deviation
                                                             << ", pdf sums up to " << r.total
                                                             << ", seed " << kSeed);
                        CHECK_INFO(r.total < 1 + 1e-3, where << ": pdf sums up to " << r.total);
                    }
                });
        }
    CHECK(tests > 200 && tests <= 400);
    std::printf("%d chi-square tests, the largest %.2f deviations, seed %u\n", tests, largest,
                kSeed);
}

TEST(lobe_sampling_weight_is_eval_over_pdf) {
    Draw draw;
    for (int round = 0; round < check::scaled(400); ++round)
        for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind) {
            const Case c = draw.lobe(kind);
            if (!c.has(kSpawnsRays)) continue;
            const Floats3 toEye = draw.toEye();
            const Floats pick = draw.unit(), u = draw.unit(), v = draw.unit();
            with(c, [&](const auto& lobe) {
                if constexpr (requires { lobe.sample(toEye, pick, u, v); }) {
                    const LobeSample s = lobe.sample(toEye, pick, u, v);
                    if (!(s.pdf.v > 0)) return;
                    const auto where = lobe_kit::shown(c) + ", to eye " + shown(toEye) +
                                       ", to light " + shown(s.toLight) + ", seed " +
                                       std::to_string(kSeed);
                    CHECK_INFO(std::fabs(dot(s.toLight, s.toLight).v - 1) < 1e-5f, where);
                    CHECK_INFO(s.toLight.z.v > 0 ? c.has(kReflects) : c.has(kTransmits), where);
                    const Floats3 eval = lobe.eval(toEye, s.toLight);
                    const Floats pdf = lobe.pdf(toEye, s.toLight);
                    if (s.single.v) {
                        CHECK_INFO(largest(eval) == 0 && pdf.v == 0, where);
                        return;
                    }
                    CHECK_INFO(isNear(s.weight * s.pdf, eval, 1e-4f),
                               where << ": weight times pdf " << shown(s.weight * s.pdf)
                                     << ", eval " << shown(eval));
                    CHECK_INFO(std::fabs(s.pdf.v - pdf.v) <= 1e-4f * pdf.v,
                               where << ": " << s.pdf.v << ", pdf() " << pdf.v);
                }
            });
        }
}

// branch() is sample() without the choice: together they send what all samples of one facet do.
TEST(lobe_sampling_branches) {
    Draw draw;
    const std::uint32_t kind = kindOf("dielectric");
    for (int round = 0; round < check::scaled(5000); ++round) {
        const Case c = draw.lobe(kind);
        const Floats3 toEye = draw.toEye();
        const Floats pick = draw.unit(), u = draw.unit(), v = draw.unit();
        const kernels::one::Dielectric lobe(LobeNumbers{c.numbers.data(), 1, Floats(c.eta)});
        const LobeSample s = lobe.sample(toEye, pick, u, v);
        const LobeSample both[] = {lobe.branch(toEye, false, u, v), lobe.branch(toEye, true, u, v)};
        for (const bool transmits : {false, true})
            if (both[transmits].pdf.v > 0) CHECK((both[transmits].toLight.z.v < 0) == transmits);
        if (s.pdf.v > 0) {
            const LobeSample& same = both[s.toLight.z.v < 0];
            CHECK(isNear(s.toLight, same.toLight, 0));
            CHECK_EQUAL(s.single.v, same.single.v);
            // The chance of the choice is in the pdf of one, not of the other.
            CHECK(isNear(s.weight * s.pdf, same.weight * same.pdf, 1e-5f));
            CHECK(s.pdf.v <= same.pdf.v * 1.00001f);
        }
    }
}

// Smooth glass: what is reflected and what is transmitted, where, and what is chosen how often.
TEST(lobe_sampling_of_smooth_glass) {
    Case c = whiteCase(kindOf("dielectric"));
    c.number("reflect_tint")[1] = 0.5f, c.number("transmit_tint")[2] = 0.25f;
    for (const float eta : {1 / 1.5f, 1.5f, 1.0f})
        for (const double cosEye : {0.1, 0.5, 0.9, 1.0}) {
            c.eta = eta;
            const kernels::one::Dielectric lobe(LobeNumbers{c.numbers.data(), 1, Floats(eta)});
            const Floats3 toEye = direction(cosEye, 1);
            const double cos2 = 1 - double{eta} * double{eta} * (1 - cosEye * cosEye);
            double f = 1;
            if (cos2 > 0) {
                const double e = double{eta}, out = std::sqrt(cos2);
                const double p = (cosEye - e * out) / (cosEye + e * out);
                const double s = (e * cosEye - out) / (e * cosEye + out);
                f = 0.5 * (p * p + s * s);
            }
            const LobeSample reflected = lobe.branch(toEye, false, 0.5f, 0.5f);
            CHECK(reflected.single.v);
            CHECK(isNear(reflected.toLight, Floats3{-toEye.x.v, -toEye.y.v, toEye.z.v}, 0));
            CHECK_NEAR(reflected.weight.x.v, f, 2e-6);
            // Total reflection keeps what would have gone through, too.
            CHECK_NEAR(reflected.weight.y.v, cos2 > 0 ? f / 2 : 1, 1e-6);
            const LobeSample sent = lobe.branch(toEye, true, 0.5f, 0.5f);
            CHECK_EQUAL(sent.pdf.v > 0, cos2 > 0);
            if (cos2 > 0) {
                CHECK_NEAR(sent.weight.x.v, 1 - f, 2e-6);
                CHECK_NEAR(sent.weight.z.v, (1 - f) / 4, 1e-6);
                CHECK_NEAR(sent.toLight.x.v, -eta * toEye.x.v, 1e-6);
                CHECK_NEAR(sent.toLight.z.v, -std::sqrt(cos2), 1e-6);
            }
            if (eta == 1)
                CHECK(isNear(sent.toLight, Floats3{-toEye.x.v, -toEye.y.v, -toEye.z.v}, 0));
            const LobeSample first = lobe.sample(toEye, 0.0f, 0.5f, 0.5f);
            const LobeSample last = lobe.sample(toEye, 0.9999999f, 0.5f, 0.5f);
            if (f > 1e-6) CHECK_NEAR(first.pdf.v, f, 2e-6);
            CHECK_NEAR(last.pdf.v, cos2 > 0 ? 1 - f : 1, 2e-6);
        }
}

} // namespace test_lobe_sampling
