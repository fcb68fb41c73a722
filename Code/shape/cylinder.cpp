#include "shape/cylinder.h"

Cylinder::Cylinder(const MovingTransform& worldFromObject, double radius, bool caps,
                   std::uint32_t material, std::uint32_t object)
    : AnalyticShape(worldFromObject, material, object, radius), caps_(caps) {
    static_assert(kSide == 0);
    measure(StillShape::Kind::Cylinder, 1u << kSide, 1u << kBottom | 1u << kTop);
}

SolidForm Cylinder::solidForm() const {
    SolidForm form = tubeForm(radius());
    if (form.hull.axis == Vec3d{} && !form.motion) return form;
    form.tube = {.shape = &still(), .caps = caps_, .radius = radius()};
    if (!form.motion) form.hull.innerRadius = radius() * roundStretch(form.hull.axis);
    return form;
}

// Where x^2 + y^2 <= radius^2.
Interval Cylinder::insideTube(const RayD& ray) const {
    const double ox = ray.org.x, oy = ray.org.y, dx = ray.dir.x, dy = ray.dir.y;
    const double dd = dx * dx + dy * dy, od = ox * dx + oy * dy;
    if (dd == 0) return Interval::all(radius() > 0 && ox * ox + oy * oy <= radius() * radius());
    const double px = ox - dx * (od / dd), py = oy - dy * (od / dd);
    return insideRound(dd, od, px * px + py * py, radius(), kSide);
}

AnalyticShape::Roots Cylinder::roots(const RayD& ray) const {
    Roots found;
    const Interval tube = insideTube(ray);
    if (caps_) {
        found.addEnds(intersection(slab(ray.org.z, ray.dir.z, -1, 1, kBottom, kTop), tube));
        return found;
    }
    if (tube.isEmpty()) return found;
    for (const Root& root : {tube.enter, tube.exit})
        if (std::fabs(ray.org.z + ray.dir.z * root.t) <= 1) found.add(root);
    return found;
}

AnalyticShape::Local Cylinder::describe(Vec3d p, std::uint32_t part,
                                        const Clearance& clearance) const {
    const Vec3d inset = clearance.inset();
    if (part != kSide) {
        const double radialInset = std::sqrt(inset.x * inset.x + inset.y * inset.y);
        return cap(p, part == kTop, radius(), radialInset);
    }
    const double around = std::sqrt(p.x * p.x + p.y * p.y);
    const double c = around > 0 ? p.x / around : 1, s = around > 0 ? p.y / around : 0;
    const double limit = 1 - min(inset.z, 0.5);
    const double z = clamp(p.z, -limit, limit);
    if (!clearance.wantsUv) return {{c * radius(), s * radius(), z}, {c, s, 0}, {}, {}, {}};
    return {{c * radius(), s * radius(), z},
            {c, s, 0},
            {0.5 + exact::atan2(s, c) * kInvTwoPi, 0.5 + 0.5 * z},
            {-s * kTwoPi * radius(), c * kTwoPi * radius(), 0},
            {0, 0, 2}};
}

BoundsD Cylinder::boxUnder(const Transform& worldFromObject) const {
    return merge(diskBox(worldFromObject, {0, 0, -1}, radius()),
                 diskBox(worldFromObject, {0, 0, 1}, radius()));
}
