// Rays between a lamp and a surface that it lights: where they end, so that no surface shadows
// itself by rounding and the edges of shadows stay where they are.
#pragma once

#include "base/hit.h"
#include "base/ray.h"

// From a lamp to the surface's point, seen from the side of `side` (+-ng): what lies on the ray is
// between them. Defined as starting at the lamp, so that all rays of a lamp share their origin.
Ray rayFromLamp(const Surface& surface, Vec3 side, Vec3 lamp, float time);
