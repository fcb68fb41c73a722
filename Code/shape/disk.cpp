#include "shape/disk.h"

Disk::Disk(const MovingTransform& worldFromObject, double radius, std::uint32_t material,
           std::uint32_t object)
    : AnalyticShape(worldFromObject, material, object, radius) {
    measure(StillShape::Kind::Disk);
}

SolidForm Disk::solidForm() const { return facesForm(StillFaces::Of::Disk, radius()); }

AnalyticShape::Roots Disk::roots(const RayD& ray) const {
    if (ray.dir.z == 0 || !(radius() > 0)) return {};
    const double t = -ray.org.z / ray.dir.z;
    const Vec3d p = ray.at(t);
    if (!(p.x * p.x + p.y * p.y <= radius() * radius())) return {};
    Roots found;
    found.add({t, 0});
    return found;
}

AnalyticShape::Local Disk::describe(Vec3d p, std::uint32_t, const Clearance&) const {
    const double side = 2 * radius();
    return {
        {p.x, p.y, 0}, {0, 0, 1}, {0.5 + p.x / side, 0.5 + p.y / side}, {side, 0, 0}, {0, side, 0}};
}

BoundsD Disk::boxUnder(const Transform& worldFromObject) const {
    return diskBox(worldFromObject, {0, 0, 0}, radius());
}
