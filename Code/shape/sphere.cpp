#include "shape/sphere.h"

#include <utility>

Sphere::Sphere(MovingTransform worldFromObject, double radius, std::uint32_t material,
               std::uint32_t object)
    : AnalyticShape(std::move(worldFromObject), material, object), radius_(radius) {}

std::optional<StillSphere> Sphere::stillSphere() const {
    const Transform* const map = stillMap();
    if (!map) return {};
    return StillSphere{map->rows(), radius_};
}

AnalyticShape::Roots Sphere::roots(const RayD& ray) const {
    const double dd = dot(ray.dir, ray.dir), od = dot(ray.org, ray.dir);
    const Vec3d perpendicular = ray.org - ray.dir * (od / dd);
    Roots found;
    found.addEnds(insideRound(dd, od, dot(perpendicular, perpendicular), radius_, 0));
    return found;
}

AnalyticShape::Local Sphere::describe(Vec3d p, std::uint32_t, const Clearance& clearance) const {
    const double distance = length(p);
    const Vec3d n = distance > 0 ? p / distance : Vec3d{0, 0, 1};
    if (!clearance.wantsUv) return {n * radius_, n, {}, {}, {}};
    const double around = std::sqrt(n.x * n.x + n.y * n.y); // cosine of the latitude
    const double c = around > 0 ? n.x / around : 1, s = around > 0 ? n.y / around : 0;
    const double across = kTwoPi * radius_ * max(around, 0x1p-20);
    const double up = kPi * radius_;
    return {n * radius_,
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
    for (std::size_t i = 0; i < 3; ++i) half[i] = radius_ * length(Vec3d{x[i], y[i], z[i]});
    return {centre - half, centre + half};
}
