// FilmUnits: in which units films sum up what they see, so that neither dim nor distant scenes lose
// digits (WholeSum keeps 2^-40 units, and up to 2^36 of them).
#pragma once

#include "render/scene.h"
#include "render/settings.h"

#include <vector>

// How many units are 1; powers of two.
struct FilmUnits {
    double color = 1;
    std::vector<double> aovs; // as in the settings
};

// Light that the exposure makes white is about a unit, and so is the size of what the camera sees
// from nearby, for places and distances.
FilmUnits filmUnitsOf(const Scene& scene, const RenderSettings& settings);
