// InfinitePlane: z = 0 of object space, without end. Its normal is +z, uv are the object's x and y.
#pragma once

#include "shape/analytic_shape.h"

class InfinitePlane final : public AnalyticShape {
public:
    InfinitePlane(const MovingTransform& worldFromObject, std::uint32_t material,
                  std::uint32_t object);
    SolidForm solidForm() const override;

private:
    Roots roots(const RayD& ray) const override;
    Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const override;
    BoundsD boxUnder(const Transform& worldFromObject) const override;
};
