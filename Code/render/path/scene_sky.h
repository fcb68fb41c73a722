// The sky of a scene as a lamp.
#pragma once

#include "light/sky/sky_table.h"
#include "texture/environment.h"

#include <memory>

// Returns how a picture around the scene is sampled. `compensated`: see SkyTable.
SkyTable skyTableOf(const Environment& environment, bool compensated, int threads);
// Returns the radiance of the picture times `factor`; without a picture that of `factor` alone.
std::unique_ptr<const SkyRadiance> skyRadianceOf(const Environment* environment, Rgb factor);
