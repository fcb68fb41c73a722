// What rays see that look at a lamp itself.
#pragma once

#include "light/light.h"

// Radiance [W/(m^2 sr)] that a ray of the unit direction `dir` takes along from the lamp's surface,
// or, for a sun, from the sky when nothing is in its way. Black for a flat lamp's back, beside a
// sun, out of a spot's cone, and for lamps without a size. The numbers are those that sample() of
// the lamp has the mean of: a mirror and a diffuse floor agree about how bright a lamp is.
Rgb seenLight(const Light& light, Vec3 dir);
