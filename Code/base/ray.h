// Ray: a half line with the part of it that counts and its time in the shutter.
// Knows nothing about shapes.
#pragma once

#include "base/math.h"
#include "base/vec.h"

// A hit counts when tMin < t < tMax; tMin is not below 0. `dir` need not be a unit vector: t is in
// units of dir. time is in [0,1] of the shutter.
struct Ray {
    Vec3 org, dir;
    float tMin = 0, tMax = kInfinityF, time = 0;
    constexpr Vec3 at(float t) const { return org + dir * t; }
};

// A ray in the space of an object, where intersections are computed in double. t is the same
// number as on the world's ray, as transforms do not normalise dir.
struct RayD {
    Vec3d org, dir;
    constexpr Vec3d at(double t) const { return org + dir * t; }
};

constexpr RayD toDouble(const Ray& ray) { return {toDouble(ray.org), toDouble(ray.dir)}; }
