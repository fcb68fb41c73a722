// The chi-square test of what is chosen against the probability that it is said to have; of
// directions, in cells of equal solid angle about an axis, against the integral of their density.
#pragma once

#include "base/math.h"
#include "base/vec.h"
#include "sample/warp.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace chi2 {

// `deviation` says how far the sum of squares is from its mean, as a normal variate (Wilson and
// Hilferty 1931): above 5 once in 3e6. Cells in which fewer than 8 are expected are put together.
struct Deviation {
    double deviation;
    std::size_t cells;
};
inline Deviation deviationOf(const std::vector<double>& expected,
                             const std::vector<double>& found) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    double sum = 0, e = 0, f = 0;
    std::size_t cells = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        e += expected[order[i]], f += found[order[i]];
        if (e < 8 && i + 1 != order.size()) continue;
        sum += sqr(f - e) / std::max(e, 1e-9);
        ++cells, e = f = 0;
    }
    const double k = static_cast<double>(std::max<std::size_t>(cells, 2) - 1);
    return {(std::cbrt(sum / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k)), cells};
}

// The cap about the axis that is cut into cells; all else is one cell more.
struct Cap {
    Vec3 axis;
    double oneMinusCos = 2;
};
struct Result {
    double deviation; // see Deviation
    double integral;  // of the density over the cap
    std::size_t cells;
};

inline constexpr std::size_t kRings = 24, kSectors = 24;

// `sample()` returns a direction, or none (then the density's integral is below 1 by its part);
// `density(Vec3)` is per steradian.
template <class Sample, class Density>
Result test(const Cap& cap, std::size_t count, Sample&& sample, Density&& density) {
    const Frame frame = frameAround(normalize(cap.axis));
    std::vector<double> found(kRings * kSectors), expected(kRings * kSectors);
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<Vec3> dir = sample();
        if (!dir) continue;
        // 1 - cos as half the square of the chord: it has its digits in narrow caps.
        const Vec3d chord = toDouble(*dir) - toDouble(frame.z);
        const double h = dot(chord, chord) / 2 / cap.oneMinusCos;
        const double turn = std::atan2(dot(toDouble(*dir), toDouble(frame.y)),
                                       dot(toDouble(*dir), toDouble(frame.x))) *
                            kInvTwoPi;
        if (!(h < 1)) continue;
        const auto ring = std::min(static_cast<std::size_t>(h * kRings), kRings - 1);
        const auto sector = std::min(
            static_cast<std::size_t>((turn < 0 ? turn + 1 : turn) * kSectors), kSectors - 1);
        ++found[ring * kSectors + sector];
    }
    const double cell = kTwoPi * cap.oneMinusCos / (kRings * kSectors);
    double integral = 0;
    // What is narrow in the cap is in few cells, which get more places each.
    const auto occupied = static_cast<double>(
        std::count_if(found.begin(), found.end(), [](double n) { return n > 0; }));
    const auto places =
        static_cast<std::size_t>(clamp(std::sqrt(2e5 / max(occupied, 1.0)), 12.0, 120.0));
    for (std::size_t ring = 0; ring < kRings; ++ring) {
        for (std::size_t sector = 0; sector < kSectors; ++sector) {
            double sum = 0;
            const std::size_t fine = found[ring * kSectors + sector] > 0 ? places : 12;
            for (std::size_t i = 0; i < fine * fine; ++i) {
                const auto part = [&](std::size_t k) {
                    return (static_cast<double>(k) + 0.5) / static_cast<double>(fine);
                };
                const double h =
                    (static_cast<double>(ring) + part(i / fine)) / kRings * cap.oneMinusCos;
                const double angle =
                    kTwoPi * (static_cast<double>(sector) + part(i % fine)) / kSectors;
                const double sine = std::sqrt(h * (2 - h));
                const Vec3d dir = toDouble(frame.x) * (sine * std::cos(angle)) +
                                  toDouble(frame.y) * (sine * std::sin(angle)) +
                                  toDouble(frame.z) * (1 - h);
                sum += static_cast<double>(density(toFloat(normalize(dir))));
            }
            const double here = sum / static_cast<double>(fine * fine) * cell;
            expected[ring * kSectors + sector] = here * static_cast<double>(count);
            integral += here;
        }
    }
    const auto [deviation, cells] = deviationOf(expected, found);
    return {deviation, integral, cells};
}

} // namespace chi2
