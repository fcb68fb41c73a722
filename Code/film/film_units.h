// FilmUnits: in which units films sum up what they see, so that neither dim nor distant scenes lose
// digits (WholeSum keeps 2^-40 units, and up to 2^36 of them).
#pragma once

#include "base/math.h"
#include "scene/scene.h"
#include "scene/settings.h"

#include <cmath>
#include <vector>

// How many units are 1; powers of two.
struct FilmUnits {
    double color = 1;
    std::vector<double> aovs; // as in the settings
};

// Light that the exposure makes white is about a unit, and so is the size of what the camera sees
// from nearby, for places and distances.
inline FilmUnits filmUnitsOf(const Scene& scene, const RenderSettings& settings) {
    FilmUnits units;
    if (settings.picture.integrator == IntegratorKind::Whitted ||
        settings.picture.integrator == IntegratorKind::Path)
        units.color =
            std::ldexp(1.0, static_cast<int>(std::floor(settings.picture.exposureEv + 0.5)));
    if (settings.picture.integrator == IntegratorKind::Depth) units.color = scene.frame().scale;
    for (const Aov aov : settings.aovs)
        units.aovs.push_back(aov == Aov::Depth || aov == Aov::Position ? scene.frame().scale : 1);
    return units;
}
