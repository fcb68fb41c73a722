#include "scene/make_shape.h"

#include "base/error.h"
#include "base/math.h"
#include "scene/frame.h"
#include "shape/checkered.h"
#include "shape/cone.h"
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/disk.h"
#include "shape/infinite_plane.h"
#include "shape/one_sided.h"
#include "shape/plane.h"
#include "shape/sphere.h"

#include <utility>

namespace {

std::unique_ptr<const Shape> bareShape(const ObjectDesc& object, const MovingTransform& place,
                                       std::uint32_t material, std::uint32_t id) {
    switch (object.kind) {
    case ObjectDesc::Kind::Sphere:
        return std::make_unique<Sphere>(place, object.radius, material, id);
    case ObjectDesc::Kind::Cube: return std::make_unique<Cube>(place, material, id);
    case ObjectDesc::Kind::Plane:
        return std::make_unique<Plane>(place, *object.corners, material, id);
    case ObjectDesc::Kind::InfinitePlane:
        return std::make_unique<InfinitePlane>(place, material, id);
    case ObjectDesc::Kind::Disk: return std::make_unique<Disk>(place, object.radius, material, id);
    case ObjectDesc::Kind::Cylinder:
        return std::make_unique<Cylinder>(place, object.radius, object.caps, material, id);
    case ObjectDesc::Kind::Cone:
        return std::make_unique<Cone>(place, object.radius, object.topRadius, object.caps, material,
                                      id);
    case ObjectDesc::Kind::Mesh: break;
    }
    fail(ErrorKind::Input, "error: an object of a kind that is not known");
}

} // namespace

std::unique_ptr<const Shape> makeShape(const ObjectDesc& object, const MovingTransform& place,
                                       std::span<const std::uint32_t> materials, std::uint32_t id) {
    auto shape = bareShape(object, place, materials[0], id);
    if (materials.size() > 1) shape = std::make_unique<Checkered>(std::move(shape), materials[1]);
    return withSides(std::move(shape), object.sides);
}

std::unique_ptr<const Shape> withSides(std::unique_ptr<const Shape> shape,
                                       ObjectDesc::Sides sides) {
    if (sides == ObjectDesc::Sides::Both) return shape;
    return std::make_unique<OneSided>(std::move(shape), sides == ObjectDesc::Sides::Front
                                                            ? OneSided::Side::Front
                                                            : OneSided::Side::Back);
}

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
