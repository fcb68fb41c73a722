// Affine maps as their twelve numbers, for those who read and check many of them: what needs no
// inverse. transform.h has the maps that things are placed with.
#pragma once

#include "base/bounds.h"

#include <array>

// Row-major 3x4, as Transform::Rows.
using AffineRows = std::array<double, 12>;

inline Vec3d vectorUnder(const AffineRows& m, Vec3d v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
            m[8] * v.x + m[9] * v.y + m[10] * v.z};
}
inline Vec3d pointUnder(const AffineRows& m, Vec3d p) {
    return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
            m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
            m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}
// First b, then a.
AffineRows product(const AffineRows& a, const AffineRows& b);
// A box around the mapped box; includes the rounding of Transform::point().
BoundsD boundsOf(const AffineRows& rows, const BoundsD& box);
