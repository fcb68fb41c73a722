// Cap: the flat end of a cylinder or a cone, at z = -1 or z = 1 of object space.
#pragma once

#include "base/math.h"
#include "base/vec.h"

struct Cap {
    Vec3d p, normal;
    Vec2d uv;
    Vec3d dpdu, dpdv;
};

// p pulled onto the cap and, if it is closer to the rim, `inset` away from it. uv is the square
// around the disk, its u turned at the bottom so that a picture is unmirrored from outside.
inline Cap cap(Vec3d p, bool top, double radius, double inset) {
    const double side = top ? 1 : -1;
    const double around = std::sqrt(p.x * p.x + p.y * p.y);
    const double limit = radius - min(inset, radius / 2);
    const double factor = around > limit ? limit / around : 1;
    const double x = p.x * factor, y = p.y * factor;
    return {{x, y, side},
            {0, 0, side},
            {0.5 + 0.5 * side * x / radius, 0.5 + 0.5 * y / radius},
            {2 * side * radius, 0, 0},
            {0, 2 * radius, 0}};
}
