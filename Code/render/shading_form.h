// The name of what shades a picture, for --stats.
#pragma once

#include "render/integrator.h"

#include <string>

// "soft lamps, lamp bodies, bounces" for waves (waves/steps.h); other integrators have one form.
std::string shadingForm(const IntegratorContext& context);
