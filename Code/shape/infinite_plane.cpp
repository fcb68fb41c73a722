#include "shape/infinite_plane.h"

InfinitePlane::InfinitePlane(const MovingTransform& worldFromObject, std::uint32_t material,
                             std::uint32_t object)
    : AnalyticShape(worldFromObject, material, object) {
    measure(StillShape::Kind::Plane);
}

SolidForm InfinitePlane::solidForm() const {
    SolidForm form = isStill() ? SolidForm{} : movingForm(kInfinity);
    form.faces = {.shape = &still(), .of = StillFaces::Of::Endless};
    return form;
}

AnalyticShape::Roots InfinitePlane::roots(const RayD& ray) const {
    Roots found;
    if (ray.dir.z != 0) found.add({-ray.org.z / ray.dir.z, 0});
    return found;
}

AnalyticShape::Local InfinitePlane::describe(Vec3d p, std::uint32_t, const Clearance&) const {
    return {{p.x, p.y, 0}, {0, 0, 1}, {p.x, p.y}, {1, 0, 0}, {0, 1, 0}, true};
}

BoundsD InfinitePlane::boxUnder(const Transform&) const {
    return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}
