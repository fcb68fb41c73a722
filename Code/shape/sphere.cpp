#include "shape/sphere.h"

Sphere::Sphere(const MovingTransform& worldFromObject, double radius, std::uint32_t material,
               std::uint32_t object)
    : AnalyticShape(worldFromObject, material, object, radius) {
    measure(StillShape::Kind::Sphere);
}

SolidForm Sphere::solidForm() const {
    if (!isStill()) {
        SolidForm form = movingForm(radius());
        form.sphere = &still();
        return form;
    }
    const Transform& map = worldFromObject();
    // Bounds of the map's stretch, by Gershgorin's circles about its Gram matrix.
    const Vec3d x = map.column(0), y = map.column(1), z = map.column(2);
    const double xy = std::fabs(dot(x, y)), yz = std::fabs(dot(y, z)), zx = std::fabs(dot(z, x));
    const double xx = dot(x, x), yy = dot(y, y), zz = dot(z, z);
    const double most = max(xx + xy + zx, max(yy + xy + yz, zz + yz + zx));
    const double least = max(0.0, min(xx - xy - zx, min(yy - xy - yz, zz - yz - zx)));
    const RoundHull hull{.centre = map.translation(),
                         .axis = {},
                         .radius = radius() * std::sqrt(most),
                         .innerRadius = radius() * std::sqrt(least)};
    return {hull, &still()};
}

AnalyticShape::Roots Sphere::roots(const RayD& ray) const {
    const double dd = dot(ray.dir, ray.dir), od = dot(ray.org, ray.dir);
    const Vec3d perpendicular = ray.org - ray.dir * (od / dd);
    Roots found;
    found.addEnds(insideRound(dd, od, dot(perpendicular, perpendicular), radius(), 0));
    return found;
}

AnalyticShape::Local Sphere::describe(Vec3d p, std::uint32_t, const Clearance& clearance) const {
    const double distance = length(p);
    const Vec3d n = distance > 0 ? p / distance : Vec3d{0, 0, 1};
    if (!clearance.wantsUv) return {n * radius(), n, {}, {}, {}};
    const double around = std::sqrt(n.x * n.x + n.y * n.y); // cosine of the latitude
    const double c = around > 0 ? n.x / around : 1, s = around > 0 ? n.y / around : 0;
    const double across = kTwoPi * radius() * max(around, 0x1p-20);
    const double up = kPi * radius();
    return {n * radius(),
            n,
            {0.5 + exact::atan2(n.y, n.x) * kInvTwoPi, 0.5 + exact::atan2(n.z, around) * kInvPi},
            {-s * across, c * across, 0},
            {-n.z * c * up, -n.z * s * up, around * up}};
}

BoundsD Sphere::boxUnder(const Transform& worldFromObject) const {
    const Vec3d centre = worldFromObject.translation();
    const Vec3d x = worldFromObject.column(0), y = worldFromObject.column(1),
                z = worldFromObject.column(2);
    Vec3d half;
    for (std::size_t i = 0; i < 3; ++i) half[i] = radius() * length(Vec3d{x[i], y[i], z[i]});
    return {centre - half, centre + half};
}
