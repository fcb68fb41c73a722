// Triangles of a polygon, convex or not.
#pragma once

#include "base/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

// Appends corners.size() - 2 triangles (none below three corners) of positions in `corners`, turned
// the same way round as the polygon. Ear clipping in the plane of Newell's normal, with signs of
// areas that are exact. Corners may be concave, collinear or repeated; a polygon that crosses
// itself gives some triangles, always as many and always in finite time. Convex polygons become the
// fan of their first corner. Triangles without area arise only where there is no other way.
void triangulate(std::span<const Vec3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

// Time grows with the square of the corners of a bad polygon (half a second for this many): readers
// refuse more than this.
inline constexpr std::size_t kMostCorners = 32768;
