#include "render/make_light.h"

#include "base/math.h"
#include "light/area_light.h"
#include "light/point_light.h"
#include "light/sun_light.h"
#include "render/to_float.h"
#include "shape/disk.h"
#include "shape/one_sided.h"
#include "shape/plane.h"
#include "shape/sphere.h"

namespace {

// Normalised radius; a lamp that is scaled unevenly takes its x axis.
float sphereRadius(const LightDesc& desc, const Transform& place) {
    return toFloat(desc.radius * length(place.vector({1, 0, 0})));
}

// A lamp's intensity and attenuation when lengths are multiplied by `scale`. Both are multiplied by
// the power of the scale that keeps the leading coefficient: the picture depends on their ratio
// only, and no scale of the scene takes them out of the range of float.
struct ScaledLamp {
    Rgb intensity;
    Attenuation attenuation;
};
ScaledLamp scaledLamp(const LightDesc& desc, double scale) {
    const Vec3d a = desc.attenuation;
    const double power = a.x > 0 ? scale * scale : a.y > 0 ? scale : 1.0;
    return {toRgb(desc.color) * toFloat(power),
            {toFloat(a.x * power / (scale * scale)), toFloat(a.y * power / scale),
             toFloat(a.z * power)}};
}

} // namespace

std::unique_ptr<const Light> makeLight(const LightDesc& desc, const SceneFrame& frame) {
    const double scale = frame.scale;
    const Transform place = frame.placed(desc.worldFromLight);
    const Vec3 position = toFloat(place.point({}));
    const Vec3 axis = toFloat(normalize(place.vector({0, 0, -1})));
    const Rgb color = toRgb(desc.color);
    switch (desc.kind) {
    case LightDesc::Kind::Point:
    case LightDesc::Kind::Spot: {
        std::optional<SpotCone> cone;
        if (desc.kind == LightDesc::Kind::Spot)
            cone = SpotCone{axis, toFloat(exact::cos(radians(desc.coneAngleDeg / 2))),
                            toFloat(desc.blend), desc.cosineFalloff};
        const ScaledLamp lamp = scaledLamp(desc, scale);
        return std::make_unique<PointLight>(position, lamp.intensity, lamp.attenuation,
                                            toFloat(desc.radius * scale), cone, desc.shadows);
    }
    case LightDesc::Kind::Sun:
        return std::make_unique<SunLight>(axis, color, radians(desc.angleDeg / 2), desc.shadows);
    case LightDesc::Kind::Rectangle:
    case LightDesc::Kind::Disk:
        return std::make_unique<FlatLight>(desc.kind == LightDesc::Kind::Rectangle
                                               ? FlatLight::Outline::Rectangle
                                               : FlatLight::Outline::Ellipse,
                                           position, toFloat(place.vector({desc.size.x / 2, 0, 0})),
                                           toFloat(place.vector({0, desc.size.y / 2, 0})), axis,
                                           color, radians(desc.spreadDeg / 2), desc.shadows);
    case LightDesc::Kind::Sphere: break;
    }
    return std::make_unique<SphereLight>(position, sphereRadius(desc, place), color, desc.shadows);
}

std::unique_ptr<const Shape> makeLampBody(const LightDesc& desc, const SceneFrame& frame,
                                          std::uint32_t material, std::uint32_t id) {
    const Transform place = frame.placed(desc.worldFromLight);
    const Transform size = Transform::scale(Vec3d{desc.size.x / 2, desc.size.y / 2, 1});
    // Lamps shine along -Z, flat shapes face +Z.
    const MovingTransform flat(place * size * Transform::rotate({1, 0, 0}, kPi));
    // Their backs are not there, as in Cycles: another lamp may stand in the same place.
    const auto shining = [](std::unique_ptr<const Shape> shape) {
        return std::make_unique<OneSided>(std::move(shape), OneSided::Side::Front);
    };
    switch (desc.kind) {
    case LightDesc::Kind::Rectangle:
        return shining(std::make_unique<Plane>(flat, kSquareCorners, material, id));
    case LightDesc::Kind::Disk: return shining(std::make_unique<Disk>(flat, 1.0, material, id));
    case LightDesc::Kind::Sphere:
        return std::make_unique<Sphere>(MovingTransform(Transform::translate(place.point({}))),
                                        static_cast<double>(sphereRadius(desc, place)), material,
                                        id);
    case LightDesc::Kind::Point:
    case LightDesc::Kind::Spot:
        if (!(desc.radius > 0)) break;
        return std::make_unique<Sphere>(MovingTransform(Transform::translate(place.point({}))),
                                        desc.radius * frame.scale, material, id);
    case LightDesc::Kind::Sun: break;
    }
    return nullptr;
}
