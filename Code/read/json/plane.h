// How the infinite plane z = 0 is placed for a plane of a JSON scene, given by a point and a
// normal.
#pragma once

#include "desc/scene_desc.h"

// An orthonormal frame with +Z along the unit normal, the origin at the point, and +X to the right
// of somebody who stands on the plane, or before it, and looks along -Z or down.
Rows planeRows(Vec3d point, Vec3d normal);

// The checkerboard has squares of 1 x 1 of the x and z of its surroundings, counted from their
// origin and not from the point: so x and y of the plane are x and z of the surroundings, sheared
// up to the plane. Nothing for a vertical plane, which lies over no squares.
bool isVerticalPlane(Vec3d normal);
Rows checkerboardRows(Vec3d point, Vec3d normal);
