// Affine maps as their twelve numbers, for those who read and check many of them: what needs no
// inverse. transform.h has the maps that things are placed with.
#pragma once

#include "base/bounds.h"

#include <array>

// Row-major 3x4, as Transform::Rows.
using AffineRows = std::array<double, 12>;

// First b, then a.
AffineRows product(const AffineRows& a, const AffineRows& b);
// A box around the mapped box; includes the rounding of Transform::point().
BoundsD boundsOf(const AffineRows& rows, const BoundsD& box);
