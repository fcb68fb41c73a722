#include "render/make_body.h"

#include "base/math.h"
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

} // namespace

std::unique_ptr<const Shape> makeLampBody(const LightDesc& desc, const SceneFrame& frame,
                                          std::uint32_t material, std::uint32_t id, bool hasBack) {
    const Transform place = frame.placed(desc.worldFromLight);
    const Transform size = Transform::scale(Vec3d{desc.size.x / 2, desc.size.y / 2, 1});
    // Lamps shine along -Z, flat shapes face +Z.
    const MovingTransform flat(place * size * Transform::rotate({1, 0, 0}, kPi));
    // As in Cycles: another lamp may stand in the same place.
    const auto shining = [&](std::unique_ptr<const Shape> shape) -> std::unique_ptr<const Shape> {
        if (hasBack) return shape;
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
