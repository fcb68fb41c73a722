// The name of what shades a picture, for --stats.
#pragma once

#include "render/integrator.h"

#include <string>

// "waves: soft lamps, lamp bodies, bounces": the steps that the waves are compiled with for this
// picture (waves/steps.h); other integrators have one form only.
std::string shadingForm(const IntegratorContext& context);
