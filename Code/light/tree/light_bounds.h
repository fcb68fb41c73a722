// LightBounds: where a light, or a group of them, is and where it shines, for the choice among
// many.
#pragma once

#include "base/bounds.h"
#include "light/light_row.h"

struct LightBounds {
    Bounds box;           // of all places on it; empty for what is distant
    Vec3 axis{0, 0, 1};   // unit: normals are around it; the way to what is distant
    double cosSpread = 1; // of the largest angle between a normal and the axis
    double cosReach = 0;  // of the largest angle to a normal at which light leaves
    double intensity = 0; // mean of the colours, along a normal [W/sr]; of what is distant the
                          // irradiance of a surface that faces it
    bool isTwoSided = false, isDistant = false;
    double reach2 = 1; // of what is distant: times the irradiance it counts as an intensity, where
                       // power alone decides

    // Whether it lights nothing: it is black, or has no area.
    bool isDark() const { return !(static_cast<float>(intensity) > 0); }
};
// Lamps that do not fade with the square of the distance count as distant, with the light that they
// give at distance 1.
LightBounds boundsOf(const LightRow& row);

// Returns the bounds of a sky; irradiance is that of a surface which sees half of it.
LightBounds boundsOfSky(double irradiance);
