// RaySpan: somebody else's batch of rays, as a structure of arrays. Ray i is element i of each.
#pragma once

#include "base/ray.h"

#include <cstddef>
#include <span>

struct RaySpan {
    std::span<const Vec3> org, dir;
    std::span<const float> tMin, tMax, time;

    std::size_t size() const { return org.size(); }
    Ray operator[](std::size_t i) const { return {org[i], dir[i], tMin[i], tMax[i], time[i]}; }
};
