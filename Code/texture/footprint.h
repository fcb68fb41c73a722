// UvFootprint: the part of a surface that a ray stands for, in texture coordinates.
#pragma once

#include "base/ray.h"
#include "base/vec.h"

// Two conjugate axes of an ellipse, each from side to side. Zero: a single point.
struct UvFootprint {
    Vec2 along, across;
    bool isPoint() const { return along == Vec2{} && across == Vec2{}; }
};

// Returns the ellipse in which a cone of some width around the unit direction `dir` meets the plane
// of a surface with the unit normal n: the one lane of footprint_in_lanes.h.
UvFootprint footprintOn(float width, Vec3 dir, Vec3 n, const SurfaceDerivatives& d);
