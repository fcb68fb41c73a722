// Rays from where a lamp sits to just in front of points, so that those of one lamp are one bundle.
//
// Let n be the normal and d the way from the lamp to the point. The end of the ray has to be
//     error + 2^-24 (|n_x d_x| + |n_y d_y| + |n_z d_z|) + rayError |d|
// above the point: the second term is what rounding d to float takes, the third what the surface's
// own test takes. A step along the normal moves the edges of all shadows by its height times the
// tangent of the lamp's angle; a step back along the ray moves none, but what touches the surface
// nearer than the step is not seen. Points keep twice the error from the walls beside them, so a
// step of the error towards the lamp stays on this side of those. It does most of it where the lamp
// is high above, and a step along the normal the rest.
#pragma once

#include "base/vec.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

LANES_BEGIN

// `dir` is not a unit vector: it ends at the point, and the ray at a parameter `end` below 1.
struct RayFromLamp {
    Floats3 dir;
    Floats end;
};

// Returns the rays to points p, raised by `lift`, that are lit on the side of the unit normal
// `side`. `error` and `rayError`: as in Surface.
inline RayFromLamp rayFromLamp(const Floats3& p, const Floats3& lift, const Floats3& side,
                               Floats pointError, Floats rayError, Vec3 lamp) {
    const auto wide = [](const Floats3& v) { return Doubles3::of(v.x, v.y, v.z); };
    const Doubles zero(0.0), error(pointError);
    const Doubles3 n = wide(side);
    const Doubles3 way = (wide(p) + wide(lift)) - forAll(toDouble(lamp));
    const Doubles reach = sqrt(dot(way, way));
    const Doubles alongX = n.x * way.x, alongY = n.y * way.y, alongZ = n.z * way.z;
    const Doubles rounding = Doubles(0x1p-24) * ((abs(alongX) + abs(alongY)) + abs(alongZ));
    const Doubles lost = rounding + Doubles(rayError) * reach;
    const Doubles part = error / reach;
    const Doubles risen = (zero - ((alongX + alongY) + alongZ)) * part;
    const Doubles step = max((error + lost) - risen, zero);
    const Mask fits = maskOf(less(error, reach)); // nothing else is in between
    const auto dir = [&](const Doubles& w, const Doubles& normal) {
        return select(fits, (w + normal * step).toFloats(), w.toFloats());
    };
    // A float that is no larger: what is rounded up is 2^-54 at least, and such a float times
    // 1 - 2^-24 is the one below it.
    const Doubles end = Doubles(1.0) - part;
    const Floats nearest = end.toFloats();
    const Mask isAbove = maskOf(less(end, Doubles(nearest)));
    const Floats under = select(isAbove, nearest * Floats(1 - 0x1p-24f), nearest);
    return {{dir(way.x, n.x), dir(way.y, n.y), dir(way.z, n.z)}, select(fits, under, Floats(0.0f))};
}

LANES_END
