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

float mean(Rgb c) { return (c.r + c.g + c.b) / 3; }

} // namespace

std::optional<PoweredLight> makeLightRow(const LightDesc& desc, const SceneFrame& frame) {
    constexpr float pi = static_cast<float>(kPi);
    const Transform place = frame.placed(desc.worldFromLight);
    const Vec3 position = toFloat(place.point({}));
    const Vec3 axis = toFloat(normalize(place.vector({0, 0, -1})));
    const Rgb color = toRgb(desc.color);
    if (isBlack(color)) return {};
    switch (desc.kind) {
    case LightDesc::Kind::Point: {
        const PointRow row = pointRow(desc, position, frame.scale);
        return PoweredLight{lightRow(row), 4 * pi * mean(row.intensity)};
    }
    case LightDesc::Kind::Spot: {
        const SpotRow row{pointRow(desc, position, frame.scale), axis,
                          toFloat(exact::cos(radians(desc.coneAngleDeg / 2))), toFloat(desc.blend),
                          desc.cosineFalloff ? 1.0f : 0.0f};
        return PoweredLight{lightRow(row),
                            2 * pi * (1 - row.cosHalfAngle) * mean(row.point.intensity)};
    }
    case LightDesc::Kind::Sun: {
        const double halfAngleRad = radians(desc.angleDeg / 2);
        const SunRow row{-axis, color,
                         toFloat(2 * sqr(exact::sin(min(halfAngleRad, kHalfPi) / 2)))};
        return PoweredLight{lightRow(row), mean(color)};
    }
    case LightDesc::Kind::Rectangle: {
        RectangleRow row;
        static_cast<FlatRow&>(row) = flatRow(desc, place, position, axis);
        const float area = 4 * length(row.halfX) * length(row.halfY);
        return PoweredLight{lightRow(row), pi * area * mean(color)};
    }
    case LightDesc::Kind::Disk: {
        DiskRow row;
        static_cast<FlatRow&>(row) = flatRow(desc, place, position, axis);
        const float area = pi * length(row.halfX) * length(row.halfY);
        return PoweredLight{lightRow(row), pi * area * mean(color)};
    }
    case LightDesc::Kind::Sphere: break;
    }
    // A lamp that is scaled unevenly takes its x axis.
    const SphereRow row{position, toFloat(desc.radius * length(place.vector({1, 0, 0}))), color};
    return PoweredLight{lightRow(row), 4 * pi * pi * sqr(row.radius) * mean(color)};
}
