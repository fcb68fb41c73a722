#include "sample/warp.h"

#include "base/math.h"
#include "sample/warps.h"

namespace {

Vec2 one(const kernels::one::Floats2& v) { return {v.x.v, v.y.v}; }
Vec3 one(const kernels::one::Floats3& v) { return {v.x.v, v.y.v, v.z.v}; }

} // namespace

Vec2 diskFromSquare(Vec2 u) { return one(kernels::one::diskFromSquare(u.x, u.y)); }

Polygon::Polygon(int blades, double rotationRad) : blades_(blades < 3 ? 0 : blades) {
    if (blades_ == 0) return;
    const double step = kTwoPi / blades_;
    for (int i = 0; i <= blades_; ++i) {
        const auto corner = exact::sinCos(rotationRad + i * step);
        corners_.push_back(corner.cos), corners_.push_back(corner.sin);
    }
}

Vec2 Polygon::fromSquare(Vec2 u) const {
    if (blades_ == 0) return diskFromSquare(u);
    return one(kernels::one::polygonFromSquare(corners(), blades_, u.x, u.y));
}

Vec3 cosineHemisphereFromSquare(Vec2 u) {
    return one(kernels::one::cosineHemisphereFromSquare(u.x, u.y));
}

Frame frameAround(Vec3 unitZ) {
    const kernels::one::ShadingFrame frame =
        kernels::one::frameAroundZ({unitZ.x, unitZ.y, unitZ.z});
    return {one(frame.x), one(frame.y), one(frame.z)};
}
