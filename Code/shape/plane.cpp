#include "shape/plane.h"

#include <utility>

namespace {

double cross2(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }
double dot2(Vec2d a, Vec2d b) { return a.x * b.x + a.y * b.y; }

StillCorners flattened(const Plane::Corners& corners) {
    StillCorners out;
    // The diagonals serve all quadrilaterals, also those with a straight or a doubled corner.
    out.normal = cross(corners[2] - corners[0], corners[3] - corners[1]);
    out.centre = (corners[0] + corners[1] + corners[2] + corners[3]) * 0.25;
    std::size_t widest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::fabs(out.normal[i]) > std::fabs(out.normal[widest])) widest = i;
    out.axisX = (widest + 1) % 3;
    out.axisY = (widest + 2) % 3;
    if (out.normal[widest] < 0) std::swap(out.axisX, out.axisY);
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2d from = out.flat(corners[i]), to = out.flat(corners[(i + 1) % 4]);
        out.edges[i] = {from, to - from};
    }
    return out;
}

} // namespace

Plane::Plane(const MovingTransform& worldFromObject, const Corners& corners, std::uint32_t material,
             std::uint32_t object)
    : AnalyticShape(worldFromObject, material, object), corners_(corners),
      flat_(flattened(corners)) {
    lend(flat_);
    measure(StillShape::Kind::Corners);
}

SolidForm Plane::solidForm() const {
    double farthest = 0;
    for (const Vec3d& corner : corners_) farthest = max(farthest, length(corner));
    return facesForm(StillFaces::Of::Corners, farthest);
}

AnalyticShape::Roots Plane::roots(const RayD& ray) const {
    const auto& [normal, centre, edges, axisX, axisY] = flat_;
    const double slope = dot(normal, ray.dir);
    const double t = dot(normal, centre - ray.org) / slope;
    if (slope == 0 || !(std::fabs(t) < kInfinity)) return {};
    const Vec2d p = flat_.flat(ray.at(t));
    for (const StillCorners::Edge& edge : edges)
        if (!(cross2(edge.way, p - edge.from) >= 0)) return {};
    Roots found;
    found.add({t, 0});
    return found;
}

// p = c0 + e u + f v + g u v; the cross product with (e + g v) leaves k2 v^2 + k1 v + k0 = 0, of
// which the root with the positive Jacobian sqrt(k1^2 - 4 k2 k0) is the one in a convex corner.
AnalyticShape::Local Plane::describe(Vec3d p, std::uint32_t, const Clearance&) const {
    const Vec3d n = flat_.normal;
    p += n * (dot(n, flat_.centre - p) / dot(n, n));
    const Vec3d e = corners_[1] - corners_[0], f = corners_[3] - corners_[0];
    const Vec3d g = corners_[2] - corners_[1] - f;
    const auto flat = [&](Vec3d v) { return flat_.flat(v); };
    const Vec2d e2 = flat(e), f2 = flat(f), g2 = flat(g), h2 = flat(p) - flat(corners_[0]);
    const double k2 = cross2(g2, f2), k1 = cross2(e2, f2) - cross2(g2, h2), k0 = -cross2(e2, h2);
    const double jacobian = std::sqrt(max(k1 * k1 - 4 * k2 * k0, 0.0));
    const double vRaw =
        k1 >= 0 ? -2 * k0 / (k1 + jacobian) : (jacobian - k1) / (2 * k2); // 0/0 gives 0 below
    const double v = clamp(vRaw, 0.0, 1.0);
    const Vec2d alongU = e2 + g2 * v;
    const double u = clamp(dot2(h2 - f2 * v, alongU) / dot2(alongU, alongU), 0.0, 1.0);
    return {p, n, {u, v}, e + g * v, f + g * u, g == Vec3d{}};
}

BoundsD Plane::boxUnder(const Transform& worldFromObject) const {
    BoundsD box;
    for (const Vec3d& corner : corners_) box.extend(worldFromObject.point(corner));
    return box;
}
