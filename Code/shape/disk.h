// Disk about the origin in z = 0 of object space, normal +z. uv is the square around it: x and y
// from -radius to radius give 0 to 1.
#pragma once

#include "shape/analytic_shape.h"

class Disk final : public AnalyticShape {
public:
    Disk(const MovingTransform& worldFromObject, double radius, std::uint32_t material,
         std::uint32_t object);
    SolidForm solidForm() const override;

private:
    Roots roots(const RayD& ray) const override;
    Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const override;
    BoundsD boxUnder(const Transform& worldFromObject) const override;
};
