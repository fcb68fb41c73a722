// Cylinder about the z axis of object space, |z| <= 1. With caps it is a solid, without them the
// side alone.
#pragma once

#include "shape/analytic_shape.h"

class Cylinder final : public AnalyticShape {
public:
    // Side: u = 1/2 + angle / 2 pi from +x towards +y, v = 0 at z = -1 to 1 at z = 1. Caps: the
    // square around the disk, unmirrored from outside (u along x on top, along -x at the bottom).
    Cylinder(const MovingTransform& worldFromObject, double radius, bool caps,
             std::uint32_t material, std::uint32_t object);

    SolidForm solidForm() const override;

private:
    enum Part : std::uint32_t {
        kSide = StillTube::Wall,
        kBottom = StillTube::Bottom,
        kTop = StillTube::Top
    };
    Roots roots(const RayD& ray) const override;
    Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const override;
    Vec3d normalAt(Vec3d p, std::uint32_t part) const override {
        return part == kSide ? Vec3d{p.x, p.y, 0} : Vec3d{0, 0, part == kTop ? 1.0 : -1.0};
    }
    BoundsD boxUnder(const Transform& worldFromObject) const override;

    Interval insideTube(const RayD& ray) const;

    bool caps_;
};
