// Cone about the z axis of object space: `radius` at z = -1, `topRadius` at z = 1, so that it may
// be cut off, stand on its tip, or be a tube. With caps it is a solid, without them the side alone.
#pragma once

#include "shape/analytic_shape.h"

class Cone final : public AnalyticShape {
public:
    // Side: u = 1/2 + angle / 2 pi from +x towards +y, v = 0 at z = -1 to 1 at z = 1. Caps: the
    // square around the disk, unmirrored from outside (u along x on top, along -x at the bottom).
    // At a tip dpdu, which would vanish, keeps 2^-20 of its length.
    Cone(const MovingTransform& worldFromObject, double radius, double topRadius, bool caps,
         std::uint32_t material, std::uint32_t object);

    Cone(const Cone&) = delete; // others point to what is in it
    SolidForm solidForm() const override;

private:
    enum Part : std::uint32_t {
        kSide = StillTube::Wall,
        kBottom = StillTube::Bottom,
        kTop = StillTube::Top
    };
    Roots roots(const RayD& ray) const override;
    Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const override;
    Vec3d normalAt(Vec3d p, std::uint32_t part) const override;
    BoundsD boxUnder(const Transform& worldFromObject) const override;

    Interval insideSide(const RayD& ray) const;

    StillCone side_;
    bool caps_;
};
