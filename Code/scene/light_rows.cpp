#include "scene/light_rows.h"

#include "base/math.h"
#include "light/kinds/disk.h"
#include "light/kinds/rectangle.h"
#include "light/kinds/round.h"
#include "light/kinds/sphere.h"
#include "light/kinds/sun.h"
#include "scene/frame.h"

namespace {

// A lamp's intensity and attenuation when lengths are multiplied by `scale`. Both are multiplied by
// the power of the scale that keeps the leading coefficient: the picture depends on their ratio
// only, and no scale of the scene takes them out of the range of float.
PointRow pointRow(const LightDesc& desc, Vec3 position, double scale) {
    const Vec3d a = desc.attenuation;
    const double power = a.x > 0 ? scale * scale : a.y > 0 ? scale : 1.0;
    return {position, toRgb(desc.color) * toFloat(power),
            toFloat(Vec3d{a.x * power / (scale * scale), a.y * power / scale, a.z * power}),
            toFloat(desc.radius * scale)};
}

} // namespace

LightRow lightRow(const LightDesc& desc, const SceneFrame& frame) {
    const Transform place = frame.placed(desc.worldFromLight);
    const Vec3 position = toFloat(place.point({}));
    const Vec3 axis = toFloat(normalize(place.vector({0, 0, -1})));
    const auto flat = [&] {
        FlatRow row{position, toFloat(place.vector({desc.size.x / 2, 0, 0})),
                    toFloat(place.vector({0, desc.size.y / 2, 0})), axis, toRgb(desc.color)};
        setSpread(row, radians(desc.spreadDeg / 2));
        return row;
    };
    switch (desc.kind) {
    case LightDesc::Kind::Point: return lightRow(pointRow(desc, position, frame.scale));
    case LightDesc::Kind::Spot:
        return lightRow(SpotRow{pointRow(desc, position, frame.scale), axis,
                                toFloat(exact::cos(radians(desc.coneAngleDeg / 2))),
                                toFloat(desc.blend), desc.cosineFalloff ? 1.0f : 0.0f});
    case LightDesc::Kind::Sun:
        return lightRow(SunRow{-axis, toRgb(desc.color),
                               toFloat(2 * sqr(exact::sin(radians(desc.angleDeg / 4))))});
    case LightDesc::Kind::Rectangle: return lightRow(RectangleRow{flat()});
    case LightDesc::Kind::Disk: return lightRow(DiskRow{flat()});
    case LightDesc::Kind::Sphere: break;
    }
    // A lamp that is scaled unevenly takes its x axis.
    return lightRow(SphereRow{position, toFloat(desc.radius * length(place.vector({1, 0, 0}))),
                              toRgb(desc.color)});
}

namespace {

// Whether a map turns, shifts and has one scale, to a millionth.
bool keepsForm(const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    const double most = dot(x, x) * 1e-6;
    const auto areAlike = [&](const Vec3d& a, const Vec3d& b) {
        return std::fabs(dot(a, b)) <= most && std::fabs(dot(b, b) - dot(a, a)) <= most;
    };
    return areAlike(x, y) && areAlike(y, z) && areAlike(x, z);
}

} // namespace

std::optional<LightRow> makeEmitterRow(const ObjectDesc& desc, const Transform& place, Rgb radiance,
                                       bool back) {
    const Vec3d x = place.vector({1, 0, 0}), y = place.vector({0, 1, 0}),
                z = place.vector({0, 0, 1});
    // A map that mirrors leaves the front of a flat shape on the other side of its edges' product.
    const double side = (dot(cross(x, y), z) < 0) != back ? -1.0 : 1.0;
    if (desc.kind == ObjectDesc::Kind::Sphere && keepsForm(x, y, z) && !back)
        return lightRow(
            SphereRow{toFloat(place.point({})), toFloat(desc.radius * length(x)), radiance});
    const auto flat = [&](auto row, const Vec3d& centre, const Vec3d& halfX, const Vec3d& halfY) {
        static_cast<FlatRow&>(row) = {toFloat(centre), toFloat(halfX), toFloat(halfY),
                                      toFloat(normalize(cross(halfX, halfY)) * side),
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
