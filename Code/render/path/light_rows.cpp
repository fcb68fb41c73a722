#include "render/path/light_rows.h"

#include "base/math.h"
#include "base/transform.h"
#include "light/kinds/disk.h"
#include "light/kinds/rectangle.h"
#include "light/kinds/round.h"
#include "light/kinds/sphere.h"
#include "light/kinds/sun.h"
#include "render/to_float.h"

namespace {

// Point lamps when lengths are multiplied by `scale`: intensity and attenuation are multiplied by
// the power of it that keeps the leading coefficient, as the picture depends on their ratio only.
PointRow pointRow(const LightDesc& desc, Vec3 position, double scale) {
    const Vec3d a = desc.attenuation;
    const double power = a.x > 0 ? scale * scale : a.y > 0 ? scale : 1.0;
    return {position,
            toRgb(desc.color) * toFloat(power),
            {toFloat(a.x * power / (scale * scale)), toFloat(a.y * power / scale),
             toFloat(a.z * power)},
            toFloat(desc.radius * scale)};
}

FlatRow flatRow(const LightDesc& desc, const Transform& place, Vec3 position, Vec3 axis) {
    FlatRow row;
    row.centre = position, row.normal = axis, row.radiance = toRgb(desc.color);
    row.halfX = toFloat(place.vector({desc.size.x / 2, 0, 0}));
    row.halfY = toFloat(place.vector({0, desc.size.y / 2, 0}));
    setSpread(row, radians(desc.spreadDeg / 2));
    return row;
}

// Whether a map turns, shifts and has one scale, to a millionth.
bool keepsForm(const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    const double most = dot(x, x) * 1e-6;
    const auto areAlike = [&](const Vec3d& a, const Vec3d& b) {
        return std::fabs(dot(a, b)) <= most && std::fabs(dot(b, b) - dot(a, a)) <= most;
    };
    return areAlike(x, y) && areAlike(y, z) && areAlike(x, z);
}

} // namespace

std::optional<LightRow> makeLightRow(const LightDesc& desc, const SceneFrame& frame) {
    const Transform place = frame.placed(desc.worldFromLight);
    const Vec3 position = toFloat(place.point({}));
    const Vec3 axis = toFloat(normalize(place.vector({0, 0, -1})));
    const Rgb color = toRgb(desc.color);
    if (isBlack(color)) return {};
    switch (desc.kind) {
    case LightDesc::Kind::Point: {
        const PointRow row = pointRow(desc, position, frame.scale);
        return lightRow(row);
    }
    case LightDesc::Kind::Spot: {
        const SpotRow row{pointRow(desc, position, frame.scale), axis,
                          toFloat(exact::cos(radians(desc.coneAngleDeg / 2))), toFloat(desc.blend),
                          desc.cosineFalloff ? 1.0f : 0.0f};
        return lightRow(row);
    }
    case LightDesc::Kind::Sun: {
        const double halfAngleRad = radians(desc.angleDeg / 2);
        const SunRow row{-axis, color,
                         toFloat(2 * sqr(exact::sin(min(halfAngleRad, kHalfPi) / 2)))};
        return lightRow(row);
    }
    case LightDesc::Kind::Rectangle: {
        RectangleRow row;
        static_cast<FlatRow&>(row) = flatRow(desc, place, position, axis);
        return lightRow(row);
    }
    case LightDesc::Kind::Disk: {
        DiskRow row;
        static_cast<FlatRow&>(row) = flatRow(desc, place, position, axis);
        return lightRow(row);
    }
    case LightDesc::Kind::Sphere: break;
    }
    // A lamp that is scaled unevenly takes its x axis.
    const SphereRow row{position, toFloat(desc.radius * length(place.vector({1, 0, 0}))), color};
    return lightRow(row);
}

std::optional<LightRow> makeEmitterRow(const ObjectDesc& desc, const Transform& place, Rgb radiance,
                                       bool back) {
    const Vec3d x = place.vector({1, 0, 0}), y = place.vector({0, 1, 0}),
                z = place.vector({0, 0, 1});
    if (desc.kind == ObjectDesc::Kind::Sphere && keepsForm(x, y, z) && !back)
        return lightRow(
            SphereRow{toFloat(place.point({})), toFloat(desc.radius * length(x)), radiance});
    const auto flat = [&](auto row, const Vec3d& centre, const Vec3d& halfX, const Vec3d& halfY) {
        static_cast<FlatRow&>(row) = {toFloat(centre), toFloat(halfX), toFloat(halfY),
                                      toFloat(normalize(cross(halfX, halfY)) * (back ? -1.0 : 1.0)),
                                      radiance};
        return lightRow(row);
    };
    const auto arePerpendicular = [](const Vec3d& a, const Vec3d& b) {
        return std::fabs(dot(a, b)) <= 1e-6 * length(a) * length(b);
    };
    if (desc.kind == ObjectDesc::Kind::Disk && arePerpendicular(x, y))
        return flat(DiskRow{}, place.point({}), x * desc.radius, y * desc.radius);
    if (desc.kind == ObjectDesc::Kind::Plane) {
        const auto& corners = *desc.corners;
        const Vec3d a = place.point(corners[0]), b = place.point(corners[1]),
                    c = place.point(corners[2]), d = place.point(corners[3]);
        const Vec3d off = (a + c) - (b + d); // 0 of a parallelogram
        if (length(off) <= 1e-6 * length(b - a) && arePerpendicular(b - a, d - a))
            return flat(RectangleRow{}, (a + c) * 0.5, (b - a) * 0.5, (d - a) * 0.5);
    }
    return {};
}
