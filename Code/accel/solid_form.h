// SolidForm: what kernels know of a shape besides its box (accel/kernels/solids.h).
#pragma once

#include "base/bounds.h"

#include <array>
#include <optional>

// All of a shape is at most this far from the centre; or, with an axis (of unit length), from the
// line through the centre along it.
struct RoundHull {
    Vec3d centre, axis;
    double radius = kInfinity;
    // A ball about the centre that is inside of a sphere; with an axis: that of a straight round
    // tube, of which the shape has all of the side.
    double innerRadius = 0;
    double halfLength = kInfinity; // along the axis, to both sides of the centre
};

// A sphere about the origin of an object space that does not move. A kernel that meets it repeats
// the formulas of shape/sphere.cpp.
struct StillSphere {
    std::array<double, 12> objectFromWorld; // Transform::rows()
    double radius = 0;
};

struct SolidForm {
    RoundHull hull;
    std::optional<StillSphere> sphere; // the shape is this one
};

inline RoundHull ballAround(const BoundsD& box) {
    return {.centre = box.centre(), .axis = {}, .radius = 0.5 * length(box.size())};
}
