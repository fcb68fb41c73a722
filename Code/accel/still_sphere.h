// StillSphere: a sphere about the origin of an object space that does not move, as kernels take it
// (accel/kernels/solids.h). Its formula is that of shape/sphere.cpp.
#pragma once

#include <array>

struct StillSphere {
    std::array<double, 12> objectFromWorld; // Transform::rows()
    double radius = 0;
};
