#include "shape/cone.h"

Cone::Cone(const MovingTransform& worldFromObject, double radius, double topRadius, bool caps,
           std::uint32_t material, std::uint32_t object)
    : AnalyticShape(worldFromObject, material, object), side_{.radius = radius,
                                                              .topRadius = topRadius,
                                                              .slope = (topRadius - radius) / 2,
                                                              .narrowZ =
                                                                  topRadius < radius ? 1.0 : -1.0,
                                                              .narrowRadius =
                                                                  min(radius, topRadius)},
      caps_(caps) {
    static_assert(kSide == 0);
    lend(side_);
    // A tip may round to its cap without size.
    measure(StillShape::Kind::Cone, 1u << kSide,
            unsigned{side_.radius > 0} << kBottom | unsigned{side_.topRadius > 0} << kTop);
}

SolidForm Cone::solidForm() const {
    SolidForm form = tubeForm(max(side_.radius, side_.topRadius));
    if (form.hull.axis == Vec3d{} && !form.motion) return form;
    form.tube = {.shape = &still(),
                 .caps = caps_,
                 .radius = side_.narrowRadius,
                 .cone = StillTube::Cone{side_.slope, side_.narrowZ}};
    if (!form.motion) form.hull.coreRadius = side_.narrowRadius * roundStretch(form.hull.axis);
    return form;
}

// Where x^2 + y^2 <= radiusAt(z)^2 and radiusAt(z) >= 0. The quadratic a t^2 + 2 b t + c is set up
// at the point of the line closest to the narrow end, so its coefficients are exact relative to the
// distance from the tip, where the sides come together, however far the ray starts.
Interval Cone::insideSide(const RayD& ray) const {
    const Vec3d d = ray.dir;
    const Vec3d org = ray.org - Vec3d{0, 0, side_.narrowZ};
    const double shift = -dot(org, d) / dot(d, d);
    const Vec3d o = org + d * shift;
    const double w = side_.narrowRadius + side_.slope * o.z, dw = side_.slope * d.z;

    const double a = d.x * d.x + d.y * d.y - dw * dw;
    const double b = o.x * d.x + o.y * d.y - w * dw;
    const double c = o.x * o.x + o.y * o.y - w * w;
    if (a == 0 && b == 0) return Interval::all(c <= 0);
    const double discriminant = differenceOfProducts(b, b, a, c);
    if (a >= 0 && !(discriminant >= 0)) return Interval::empty();
    // A steep line (a < 0) always meets both halves of the double cone: below 0 is rounding.
    const double q = -(b + std::copysign(std::sqrt(max(discriminant, 0.0)), b));
    const double stable = q != 0 ? c / q : 0; // stays finite as a goes to 0
    if (a == 0) {
        const Root end{shift + stable, kSide};
        return b > 0 ? Interval{{-kInfinity, kSide}, end} : Interval{end, {kInfinity, kSide}};
    }
    const double other = q / a;
    const Root low{shift + min(stable, other), kSide}, high{shift + max(stable, other), kSide};
    if (a > 0) return {low, high};
    // Steep: inside outside the roots; the half where the radius is positive counts.
    return dw > 0 ? Interval{high, {kInfinity, kSide}} : Interval{{-kInfinity, kSide}, low};
}

AnalyticShape::Roots Cone::roots(const RayD& ray) const {
    Roots found;
    const Interval side = insideSide(ray);
    if (caps_) {
        found.addEnds(intersection(side, slab(ray.org.z, ray.dir.z, -1, 1, kBottom, kTop)));
        return found;
    }
    if (side.isEmpty()) return found;
    for (const Root& root : {side.enter, side.exit})
        if (std::fabs(ray.org.z + ray.dir.z * root.t) <= 1) found.add(root);
    return found;
}

AnalyticShape::Local Cone::describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const {
    const Vec3d inset = clearance.inset();
    const double radialInset = std::sqrt(inset.x * inset.x + inset.y * inset.y);
    const double capRadius = part == kTop ? side_.topRadius : side_.radius;
    if (part != kSide && capRadius > 0) // a tip may round to its cap without size
        return cap(p, part == kTop, capRadius, radialInset + std::fabs(side_.slope) * inset.z);

    const double around = std::sqrt(p.x * p.x + p.y * p.y);
    const double limit = 1 - min(inset.z, 0.5);
    double z = clamp(p.z, -limit, limit);
    double w = side_.radiusAt(z);
    // The tip itself takes a normal of the side too: along the axis, a ray inwards would leave a
    // slim or slanted cone at once.
    const double c = around > 0 ? p.x / around : 1, s = around > 0 ? p.y / around : 0;
    const Vec3d normal{c, s, -side_.slope};

    // Near the tip the side is so curved that a step inwards may end outside: a step e (half the
    // clearance) goes in by e steepness, but with rounding it may go round by 3/4 radialInset, and
    // so out again by the square of that over 2 w. p goes down the side to where there is room,
    // with a factor of 4 to spare.
    const double wide = max(side_.radius, side_.topRadius);
    double leastRadius = 0;
    if (radialInset > 0 && w < wide / 2) {
        const double inwards = 0.5 * clearance.distance * clearance.steepness(normal);
        leastRadius = min(2 * sqr(0.75 * radialInset) / inwards, wide / 2);
    }
    if (w < leastRadius) {
        w = leastRadius;
        z = side_.narrowZ + (w - side_.narrowRadius) / side_.slope;
    }
    if (!clearance.wantsUv) return {{c * w, s * w, z}, normal, {}, {}, {}};
    const double across = kTwoPi * max(w, 0x1p-20 * wide);
    return {{c * w, s * w, z},
            normal,
            {0.5 + exact::atan2(s, c) * kInvTwoPi, 0.5 + 0.5 * z},
            {-s * across, c * across, 0},
            {2 * side_.slope * c, 2 * side_.slope * s, 2}};
}

Vec3d Cone::normalAt(Vec3d p, std::uint32_t part) const {
    if (part != kSide) return AnalyticShape::normalAt(p, part);
    return {p.x, p.y, -side_.slope * std::sqrt(p.x * p.x + p.y * p.y)};
}

BoundsD Cone::boxUnder(const Transform& worldFromObject) const {
    return merge(diskBox(worldFromObject, {0, 0, -1}, side_.radius),
                 diskBox(worldFromObject, {0, 0, 1}, side_.topRadius));
}
