#include "light/tree/light_tree.h"

#include "base/math.h"

#include <array>

namespace {

double byFormula(double cosSpread, double cosReach) {
    const double o = exact::acos(clamp(cosSpread, -1.0, 1.0)), e = exact::acos(cosReach);
    const double w = min(o + e, kPi), sine = exact::sin(o);
    return kTwoPi * (1 - cosSpread) +
           kHalfPi * (2 * w * sine - exact::cos(o - 2 * w) - 2 * o * sine + cosSpread);
}

// The table goes by the sine of half the angle, in which the measure is smooth.
constexpr std::size_t kSteps = 128;
const std::array<double, kSteps + 2>& table() {
    static const auto made = [] {
        std::array<double, kSteps + 2> out{};
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double s = static_cast<double>(i) / kSteps;
            out[i] = byFormula(max(1 - 2 * s * s, -1.0), 0);
        }
        return out;
    }();
    return made;
}

} // namespace

double directionsOf(double cosSpread, double cosReach) {
    if (cosReach != 0) return byFormula(cosSpread, cosReach);
    const double at = std::sqrt(clamp((1 - cosSpread) / 2, 0.0, 1.0)) * kSteps;
    const auto i = static_cast<std::size_t>(at);
    return lerp(table()[i], table()[i + 1], at - static_cast<double>(i));
}
