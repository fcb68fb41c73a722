// A ray from where a lamp sits to just in front of a point, of one lane.
#pragma once

#include "base/ray.h"
#include "integrate/ray_from_lamp.h"

// The point is lit on the side of the unit normal `side`.
inline Ray rayFromLamp(const Surface& surface, Vec3 side, Vec3 lamp, float time) {
    const auto one = [](Vec3 v) { return kernels::one::Floats3{v.x, v.y, v.z}; };
    const kernels::one::RayFromLamp ray = kernels::one::rayFromLamp(
        one(surface.p), one(surface.lift), one(side), surface.error, surface.rayError, lamp);
    return {lamp, {ray.dir.x.v, ray.dir.y.v, ray.dir.z.v}, 0, ray.end.v, time};
}
