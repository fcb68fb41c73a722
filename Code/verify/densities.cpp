// T22: what is sampled has the density that it is said to have: directions of lobes, of lamps and
// of skies, and the choice of one light of many. Integrators that weigh two kinds of samples
// against each other (Veach 1997) are wrong by as much as these are.
#include "base/text.h"
#include "light/kinds/sky.h"
#include "light/tree/light_tree.h"
#include "light/tree/pick_lanes.h"
#include "texture/environment.h"
#include "verify/chi2.h"
#include "verify/groups.h"
#include "verify/light_kit.h"
#include "verify/lobe_kit.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace battery {

namespace {

using namespace light_kit;
using meshes::Random;

// Sampled directions of a lobe in terms of z and phi, from 0 to 2 pi, pi away from the eye.
struct Drawn {
    std::vector<double> z, phi;
    Drawn(const lobe_kit::Case& c, const lobe_kit::Floats3& toEye, int count, Random& random) {
        for (int i = 0; i < count; ++i)
            lobe_kit::withSample(c, toEye, random, [&](const auto&, const auto& s) {
                if (!(s.pdf.v > 0)) return;
                const Vec3d d = toDouble(plain(s.toLight));
                const double turn = std::atan2(d.y, d.x);
                z.push_back(d.z), phi.push_back(turn < 0 ? turn + kTwoPi : turn);
            });
    }
};

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

// 4,000 directions in up to 88 parts, which the lobe's own samples divide, against integrals.
double deviationOf(const lobe_kit::Case& c, double cosEye, Random& random) {
    const lobe_kit::Floats3 toEye = lobe_kit::direction(cosEye, 0);
    const Drawn pilot(c, toEye, 1000, random);
    std::vector<double> heights = bordersOf(pilot.z, 10, -1, 1);
    const std::vector<double> turns = bordersOf(pilot.phi, 8, 0, kTwoPi);
    if (std::find(heights.begin(), heights.end(), 0) == heights.end())
        heights.insert(std::lower_bound(heights.begin(), heights.end(), 0), 0);

    constexpr int kCount = 4000;
    const Drawn drawn(c, toEye, kCount, random);
    const std::size_t columns = turns.size() - 1;
    std::vector<double> expected, counts((heights.size() - 1) * columns + 1);
    const auto peaks = lobe_kit::peaksOf(c, cosEye);
    double total = 0;
    lobe_kit::with(c, [&](const auto& lobe) {
        if constexpr (requires { lobe.pdf(toEye, toEye); }) {
            const auto f = [&](double z, double phi) {
                return static_cast<double>(lobe.pdf(toEye, lobe_kit::direction(z, phi)).v);
            };
            const lobe_kit::Integral integral(f, 4e-6, peaks);
            for (std::size_t i = 0; i + 1 < heights.size(); ++i)
                for (std::size_t j = 0; j < columns; ++j) {
                    // Halves at least, so that narrow strips are seen.
                    const double middle = 0.5 * (turns[j] + turns[j + 1]);
                    const double part =
                        integral.over(heights[i], heights[i + 1], turns[j], middle) +
                        integral.over(heights[i], heights[i + 1], middle, turns[j + 1]);
                    total += part, expected.push_back(part * kCount);
                }
        }
    });
    expected.push_back(max(1 - total, 0.0) * kCount); // nothing is sampled
    counts.back() = kCount - static_cast<double>(drawn.z.size());
    const auto in = [](const std::vector<double>& borders, double x) {
        const auto at = std::upper_bound(borders.begin() + 1, borders.end() - 1, x);
        return static_cast<std::size_t>(at - borders.begin()) - 1;
    };
    for (std::size_t i = 0; i < drawn.z.size(); ++i)
        ++counts[in(heights, drawn.z[i]) * columns + in(turns, drawn.phi[i])];
    return chi2::deviationOf(expected, counts).deviation;
}

// One batch is one direction of the eye for every lobe that is sampled, of one of ten roughnesses,
// and some that are wider along one axis.
Tally lobes(const Effort& effort) {
    return inBatches(effort, 221, 5, [](Random& random, Tally& tally) {
        for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind) {
            const auto all = lobe_kit::casesOf(kind);
            lobe_kit::Case c = all[random.below(all.size())];
            if (!c.has(kSpawnsRays | kAnswersLights)) continue;
            const double cosEye = random.uniform(0.05, 1);
            if (float* const anisotropy = c.number("anisotropy");
                anisotropy && random.chance(0.3)) {
                *anisotropy = random.chance(0.5) ? -0.6f : 0.9f, *c.number("roughness") = 0.5f;
                if (float* const rotation = c.number("rotation")) *rotation = 0.1f;
                c.width = 0.25f * std::sqrt(1 - 0.9f * std::fabs(*anisotropy));
            }
            ++tally.cases;
            tally.measure(deviationOf(c, cosEye, random),
                          [&] { return cat(lobe_kit::shown(c), ", cosine of the eye ", cosEye); });
        }
    });
}

Vec2 square(Random& random) {
    const Vec2 u = random.square();
    return {min(u.x, kOneMinusUlp), min(u.y, kOneMinusUlp)};
}

// The cap of directions in which a lamp is, from some of its samples.
chi2::Cap capOf(const OneLight& light, Vec3 p, Random& random) {
    Vec3 sum;
    std::vector<Vec3> seen;
    for (int i = 0; i < 400; ++i) {
        const Sample s = light.sample(p, square(random));
        if (s.pdf > 0) seen.push_back(s.toLight), sum = sum + s.toLight;
    }
    if (seen.empty()) return {};
    const Vec3 axis = normalize(sum);
    double far = 0;
    for (const Vec3 dir : seen) {
        const Vec3d chord = toDouble(dir) - toDouble(axis);
        far = max(far, dot(chord, chord) / 2);
    }
    return {axis, min(far * 1.3, 2.0)};
}

// A density that is off by 10 % in half of the directions deviates by 9.
Tally lamps(const Effort& effort) {
    return inBatches(effort, 222, 1, [](Random& random, Tally& tally) {
        const auto size = static_cast<float>(random.logUniform(0.05, 3));
        for (const OneLight& light : lampsOfSize(random, toFloat(random.inBox(1)), size)) {
            const Vec3 p = toFloat(random.inBox(1.5));
            const chi2::Cap cap = capOf(light, p, random);
            if (cap.axis == Vec3{}) continue; // behind the lamp
            const chi2::Result found = chi2::test(
                cap, 30000,
                [&]() -> std::optional<Vec3> {
                    const Sample s = light.sample(p, square(random));
                    if (!(s.pdf > 0)) return {};
                    return s.toLight;
                },
                [&](Vec3 dir) { return light.pdf(p, dir); });
            if (found.cells < 100) continue; // a sliver: its border is in every cell
            const auto text = [&] {
                return cat(light.name(), " of size ", size, ", integral ", found.integral);
            };
            ++tally.cases;
            // The border of the lamp is off by a fraction of the finest cells: below 1 %.
            if (!(std::fabs(found.integral - 1) < 0.012)) tally.fail(text);
            tally.measure(found.deviation, text);
        }
    });
}

// How far what a sample said is from what fn(its direction) says, relative. Directions are rounded
// to floats, which moves them by 2^-24: those that much beside are as good, at borders and on lamps
// that are seen nearly edge-on.
template <class Fn> double offSaid(const Sample& s, float said, const Fn& fn) {
    const Frame frame = frameAround(s.toLight);
    float least = kInfinityF, most = 0;
    for (const float step : {0.0f, 0x1p-24f, 0x1p-23f})
        for (const Vec3 off : {frame.x, frame.x * -1.0f, frame.y, frame.y * -1.0f}) {
            const float here = fn(normalize(s.toLight + off * step));
            least = min(least, here), most = max(most, here);
        }
    // They step over slivers of less than 1e-5 sr, or onto few places of them.
    if (least == 0 && s.pdf > 1e5f) return 0;
    return static_cast<double>(max(max(least / said - 1, 1 - most / said), 0.0f));
}

// All of the sky by samples, too, against directions without a table; samples of a compensated one
// leave out what is dim.
Tally skies(const Effort& effort) {
    return inBatches(effort, 223, 1, [](Random& random, Tally& tally) {
        const auto up = random.chance(0.5) ? Environment::Up::Z : Environment::Up::Y;
        const int width = 4 + static_cast<int>(random.below(12));
        const Environment environment(skyImage(random, width, 7, 1), ColorSpace::Linear,
                                      Interpolation::Bilinear, up, random.unit());
        const SkyRadiance picture{&environment};
        const SkyCells cells = skyCells(environment, kMostSkyColumns, kMostSkyRows);
        for (const bool compensated : {false, true}) {
            const SkyTable table(cells.width, cells.height, cells.luminance, compensated,
                                 environment.place());
            const kernels::one::SkyEmitter sky(table.view(picture));
            const auto pdf = [&](Vec3 dir) { return sky.pdf({0, 0, 0}, lane(dir)).v; };
            constexpr int kCount = 20000;
            double sum = 0, even = 0, squares = 0;
            const auto text = [&] {
                return cat(width, compensated ? " columns, compensated" : "");
            };
            const chi2::Result found = chi2::test(
                {unitVector(random), 2}, kCount,
                [&]() -> std::optional<Vec3> {
                    const Vec2 u = square(random);
                    const Sample s = plain(sky.sample({0, 0, 0}, u.x, u.y));
                    sum += static_cast<double>(s.irradiance.g);
                    if (!(offSaid(s, s.pdf, pdf) < 1e-4)) tally.fail(text);
                    return s.toLight;
                },
                pdf);
            for (int i = 0; i < kCount; ++i) {
                const double light =
                    4 * kPi * static_cast<double>(environment.radiance(unitVector(random)).g);
                even += light, squares += light * light;
            }
            ++tally.cases;
            const double sigma = std::sqrt(squares - even * even / kCount);
            if (!(std::fabs(sum - even) < 8 * sigma) && !compensated) tally.fail(text);
            if (!(std::fabs(found.integral - 1) < 0.012)) tally.fail(text);
            tally.measure(found.deviation, text);
        }
    });
}

// Picks are counted against probabilities; and what is left of the random number is even.
Tally choices(const Effort& effort) {
    return inBatches(effort, 224, 5, [](Random& random, Tally& tally) {
        constexpr int kPicks = 10000;
        const auto rows = someLights(random, random.chance(0.5) ? 12 : 60, random.chance(0.7));
        const LightPicker picker(boundsOf(rows));
        const kernels::one::LightChoice choice(picker.view());
        const auto p = lane(toFloat(random.inBox(2))), n = lane(unitVector(random));
        std::vector<double> expected, found(rows.size()), halves(2);
        for (std::uint32_t k = 0; k < rows.size(); ++k)
            expected.push_back(kPicks * static_cast<double>(choice.probability(p, n, k).v));
        for (int i = 0; i < kPicks; ++i) {
            const auto picked = choice.pick(p, n, random.unit());
            ++found[picked.light.v], ++halves[picked.u.v < 0.5 ? 0 : 1];
            if (picked.probability.v != choice.probability(p, n, picked.light).v)
                tally.fail([&] { return cat("light ", picked.light.v, " of ", rows.size()); });
        }
        ++tally.cases;
        const auto text = [&] { return cat(rows.size(), " lights"); };
        tally.measure(chi2::deviationOf(expected, found).deviation, text);
        tally.measure(chi2::deviationOf({kPicks / 2, kPicks / 2}, halves).deviation, text);
    });
}

// Compares the answers of a lamp, whose radiance is met along the direction, too.
void compareLamp(const OneLight& light, Vec3 p, Random& random, Tally& tally) {
    const Sample s = light.sample(p, square(random));
    if (isBlack(s.irradiance) || s.single) return;
    const double density = offSaid(s, s.pdf, [&](Vec3 dir) { return light.pdf(p, dir); });
    const double radiance =
        offSaid(s, s.irradiance.g * s.pdf, [&](Vec3 dir) { return light.meet(p, dir).radiance.g; });
    const double nearness =
        offSaid(s, 1 / s.distance, [&](Vec3 dir) { return 1 / light.meet(p, dir).distance; });
    const auto text = [&] { return cat(light.name(), ", density ", s.pdf); };
    ++tally.cases;
    tally.measure(density, text), tally.measure(radiance, text);
    if (s.distance < kInfinityF) tally.measure(nearness, text);
}

// Compares the answers of lobes, whose weights are what eval() says over the density.
void compareLobe(std::uint32_t kind, Random& random, Tally& tally) {
    const lobe_kit::Case c = lobe_kit::anyCase(kind, random);
    const auto toEye = lobe_kit::direction(random.uniform(1e-3, 1), random.uniform(0, kTwoPi));
    lobe_kit::withSample(c, toEye, random, [&](const auto& lobe, const auto& s) {
        if (!(s.pdf.v > 0)) return;
        const auto eval = lobe.eval(toEye, s.toLight);
        const double whole = lobe_kit::largest(eval), pdf = lobe.pdf(toEye, s.toLight).v;
        const auto text = [&] {
            return cat(lobe_kit::shown(c), ", eye at cosine ", toEye.z.v, ": ", s.pdf.v, ", pdf() ",
                       pdf, ", eval() ", whole);
        };
        ++tally.cases;
        if (!(std::fabs(dot(s.toLight, s.toLight).v - 1) < 1e-5f)) tally.fail(text);
        if (!c.has(s.toLight.z.v > 0 ? kReflects : kTransmits)) tally.fail(text);
        if (s.single.v) {
            if (!(whole == 0 && pdf == 0)) tally.fail(text);
            return;
        }
        tally.measure(std::fabs(pdf / static_cast<double>(s.pdf.v) - 1), text);
        const Vec3 off = plain(s.weight * s.pdf - eval);
        tally.measure(
            static_cast<double>(max(max(std::fabs(off.x), std::fabs(off.y)), std::fabs(off.z))) /
                max(whole, 1e-30),
            text);
    });
}

Tally answers(const Effort& effort) {
    return inBatches(effort, 225, 10, [](Random& random, Tally& tally) {
        for (int i = 0; i < 50; ++i) {
            const auto size = static_cast<float>(random.logUniform(1e-3, 10));
            for (const OneLight& light : lampsOfSize(random, toFloat(random.inBox(1)), size))
                compareLamp(light, toFloat(random.inBox(2)), random, tally);
            for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind)
                compareLobe(kind, random, tally);
        }
    });
}

// The largest of 10,000 deviations is above 5.5 once in 5,000 runs.
constexpr double kDeviations = 5.5;

constexpr Row kDensityRows[] = {
    {"T22a", "directions of lobes against their density, chi-square", "deviations", kDeviations,
     true, lobes},
    {"T22b", "the same of lamps", "deviations", kDeviations, true, lamps},
    {"T22c", "the same of pictures around the scene", "deviations", kDeviations, true, skies},
    {"T22d", "choice of one light of many against its probabilities", "deviations", kDeviations,
     true, choices},
    {"T22e", "what samples of lamps and lobes say and pdf() and eval() say", "relative", 2e-4, true,
     answers},
};

} // namespace

std::span<const Row> densityRows() { return kDensityRows; }

} // namespace battery
