// Cube [-1,1]^3 of object space; an affine map makes it any box or parallelepiped.
#pragma once

#include "shape/analytic_shape.h"

class Cube final : public AnalyticShape {
public:
    // Every face shows the whole unit square, unmirrored from outside: on the four sides v goes up
    // along z and u to the right, on top u = x, v = y, at the bottom u = -x, v = y.
    Cube(const MovingTransform& worldFromObject, std::uint32_t material, std::uint32_t object);

    SolidForm solidForm() const override;

private:
    // part: 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z
    Roots roots(const RayD& ray) const override;
    Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const override;
    BoundsD boxUnder(const Transform& worldFromObject) const override;
};
