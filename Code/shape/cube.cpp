#include "shape/cube.h"

namespace {

struct Face {
    std::size_t axis;
    double side;
    Vec3d right, up; // right x up = outward
};
constexpr Face kFaces[] = {
    {0, -1, {0, -1, 0}, {0, 0, 1}}, {0, 1, {0, 1, 0}, {0, 0, 1}},   {1, -1, {1, 0, 0}, {0, 0, 1}},
    {1, 1, {-1, 0, 0}, {0, 0, 1}},  {2, -1, {-1, 0, 0}, {0, 1, 0}}, {2, 1, {1, 0, 0}, {0, 1, 0}},
};

} // namespace

Cube::Cube(const MovingTransform& worldFromObject, std::uint32_t material, std::uint32_t object)
    : AnalyticShape(worldFromObject, material, object) {
    measure(StillShape::Kind::Cube, (1u << std::size(kFaces)) - 1);
}

SolidForm Cube::solidForm() const {
    const double farthestCorner = std::sqrt(3.0);
    if (!isStill()) return facesForm(StillFaces::Of::Cube, farthestCorner);
    const Transform& map = worldFromObject();
    double farthest = 0; // corner
    for (int i = 0; i < 4; ++i) {
        const Vec3d corner = BoundsD{{-1, -1, -1}, {1, 1, 1}}.corner(i);
        farthest = max(farthest, length(map.vector(corner)));
    }
    RoundHull hull{.centre = map.translation(), .axis = {}, .radius = farthest};
    // Up to the nearest face; not of those so slim or slanted that the inverse is no good for it.
    const AffineRows& m = map.inverseRows();
    double steepest = 0;
    for (std::size_t i = 0; i < 12; i += 4)
        steepest = max(steepest, length(Vec3d{m[i], m[i + 1], m[i + 2]}));
    if (steepest > 0 && steepest * farthest < 0x1p20) hull.innerRadius = 1 / steepest;
    SolidForm form = facesForm(StillFaces::Of::Cube, farthestCorner);
    form.hull = hull;
    return form;
}

AnalyticShape::Roots Cube::roots(const RayD& ray) const {
    const Interval x = slab(ray.org.x, ray.dir.x, -1, 1, 0, 1);
    const Interval y = slab(ray.org.y, ray.dir.y, -1, 1, 2, 3);
    const Interval z = slab(ray.org.z, ray.dir.z, -1, 1, 4, 5);
    Roots found;
    found.addEnds(intersection(intersection(x, y), z));
    return found;
}

AnalyticShape::Local Cube::describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const {
    const Vec3d inset = clearance.inset();
    const Face& face = kFaces[part % 6];
    for (std::size_t i = 0; i < 3; ++i) {
        const double limit = 1 - min(inset[i], 0.5);
        p[i] = i == face.axis ? face.side : clamp(p[i], -limit, limit);
    }
    Vec3d normal;
    normal[face.axis] = face.side;
    return {p,
            normal,
            {0.5 + 0.5 * dot(p, face.right), 0.5 + 0.5 * dot(p, face.up)},
            face.right * 2.0,
            face.up * 2.0};
}

// That of the mapped corners, to the last bit: rounding keeps the order of sums.
BoundsD Cube::boxUnder(const Transform& worldFromObject) const {
    BoundsD box;
    for (std::size_t i = 0; i < 3; ++i) {
        const double* const m = &worldFromObject.rows()[4 * i];
        const double reach = std::fabs(m[0]) + std::fabs(m[1]) + std::fabs(m[2]);
        box.lo[i] = m[3] - reach, box.hi[i] = m[3] + reach;
    }
    return box;
}
