#include "render/lamp_ray.h"

// With n the normal and d the way from the lamp to the point, the end of the ray has to be
//     surface.error + 2^-24 (|n_x d_x| + |n_y d_y| + |n_z d_z|) + surface.rayError |d|
// above the point: the second term is what rounding d to float takes, the third what the surface's
// own test takes. A step along the normal moves the edges of all shadows by its height times the
// tangent of the lamp's angle; a step back along the ray moves none, but what touches the surface
// nearer than the step is not seen. Points keep twice the error from the walls beside them, so a
// step of the error towards the lamp stays on this side of those. It does most of it where the lamp
// is high above, and a step along the normal the rest.
Ray rayFromLamp(const Surface& surface, Vec3 side, Vec3 lamp, float time) {
    constexpr double kRounding = 0x1p-24;
    const Vec3d n = toDouble(side);
    const Vec3d way = toDouble(surface.p) + toDouble(surface.lift) - toDouble(lamp);
    const double reach = length(way), error = static_cast<double>(surface.error);
    if (!(reach > error)) return {lamp, toFloat(way), 0, 0, time}; // nothing fits in between
    const double rounding =
        kRounding * (std::fabs(n.x * way.x) + std::fabs(n.y * way.y) + std::fabs(n.z * way.z));
    const double lost = rounding + static_cast<double>(surface.rayError) * reach;
    const double risen = -dot(n, way) / reach * error;
    const Vec3 dir = toFloat(way + n * max(error + lost - risen, 0.0));
    return {lamp, dir, 0, floatBelow(1 - error / reach), time};
}
