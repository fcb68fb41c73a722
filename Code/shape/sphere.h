// Sphere about the origin of its object space; an affine map makes it any ellipsoid.
#pragma once

#include "shape/analytic_shape.h"

class Sphere final : public AnalyticShape {
public:
    // u = 1/2 + longitude / 2 pi, longitude 0 along +x, growing towards +y; v = 1/2 + latitude/pi,
    // 0 at the lower pole. At the poles dpdu, which would vanish, keeps 2^-20 of its length.
    Sphere(const MovingTransform& worldFromObject, double radius, std::uint32_t material,
           std::uint32_t object);

    SolidForm solidForm() const override;

private:
    Roots roots(const RayD& ray) const override;
    Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const override;
    BoundsD boxUnder(const Transform& worldFromObject) const override;
};
