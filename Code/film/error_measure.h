// ErrorMeasure: how much an error of the light of a pixel counts, in the unit that --error is given in.
// Knows numbers only.
#pragma once

#include "base/math.h"
#include "image/colour.h"
#include "scene/settings.h"

#include <array>
#include <cmath>
#include <cstddef>

class ErrorMeasure {
public:
    // Values are multiplied by `exposure`, and shown as `transfer` has it.
    ErrorMeasure(ErrorUnit unit, double exposure, SettingsDesc::Transfer transfer)
        : unit_(unit), exposure_(exposure) {
        if (unit != ErrorUnit::Display) return;
        for (std::size_t i = 0; i < shown_.size(); ++i) {
            const auto light = static_cast<float>(sqr(static_cast<double>(i) / kSteps));
            shown_[i] = transfer == SettingsDesc::Transfer::Srgb
                            ? static_cast<double>(srgbFromLinear(light))
                            : static_cast<double>(light);
        }
    }

    // Returns the error of a channel whose mean is `mean` and whose standard deviation is `deviation`,
    // both as the film has them. Display: half the difference of what is shown of the mean plus and minus
    // the deviation, so that clipped values have no error. Relative: against the mean, as relMSE with 0.01.
    double of(double mean, double deviation) const {
        const double light = mean * exposure_, spread = deviation * exposure_;
        switch (unit_) {
        case ErrorUnit::Display: return (shown(light + spread) - shown(light - spread)) / 2;
        case ErrorUnit::Linear: return spread;
        case ErrorUnit::Relative: break;
        }
        return spread / std::sqrt(sqr(light) + 0.01);
    }

private:
    static constexpr int kSteps = 1024;

    // What is shown, from 0 to 1: by a table over the root of light, whose lines are within 2e-4 of the
    // curve.
    double shown(double light) const {
        if (!(light > 0)) return 0;
        if (light >= 1) return 1;
        const double place = std::sqrt(light) * kSteps;
        const auto below = static_cast<std::size_t>(place);
        return lerp(shown_[below], shown_[below + 1], place - static_cast<double>(below));
    }

    ErrorUnit unit_;
    double exposure_;
    std::array<double, kSteps + 2> shown_{};
};
