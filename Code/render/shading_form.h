// The name of what shades a picture, for --stats.
#pragma once

#include "render/integrator.h"

#include <string>

// "waves: soft lamps, lamp bodies, bounces, maps of 2 lamps": the steps that the waves are compiled
// with for this picture (waves/steps.h), and how many lamps have a map (lamp_map/lamp_map.h); other
// integrators have one form only.
std::string shadingForm(const IntegratorContext& context);
