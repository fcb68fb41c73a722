// Plane: a flat convex quadrilateral with any four coplanar corners.
#pragma once

#include "shape/analytic_shape.h"

class Plane final : public AnalyticShape {
public:
    using Corners = std::array<Vec3d, 4>;
    // Corners in order around the edge; the normal points to where they turn counter-clockwise (+z
    // for the square of scene_desc.h). uv is (0,0), (1,0), (1,1), (0,1) at the corners, and between
    // them p = bilinear(uv). Corners on a line give a shape that no ray meets.
    Plane(const MovingTransform& worldFromObject, const Corners& corners, std::uint32_t material,
          std::uint32_t object);
    Plane(const Plane&) = delete;                               // others point to what is in it
    SolidForm solidForm() const override;

private:
    Roots roots(const RayD& ray) const override;
    Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const override;
    BoundsD boxUnder(const Transform& worldFromObject) const override;

    Corners corners_;
    StillCorners flat_;
};
