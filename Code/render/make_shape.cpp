#include "render/make_shape.h"

#include "base/error.h"
#include "shape/cone.h"
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/disk.h"
#include "shape/infinite_plane.h"
#include "shape/plane.h"
#include "shape/sphere.h"

#include <utility>

std::unique_ptr<const Shape> makeShape(const ObjectDesc& object, MovingTransform place,
                                       std::uint32_t material, std::uint32_t id) {
    switch (object.kind) {
    case ObjectDesc::Kind::Sphere:
        return std::make_unique<Sphere>(std::move(place), object.radius, material, id);
    case ObjectDesc::Kind::Cube: return std::make_unique<Cube>(std::move(place), material, id);
    case ObjectDesc::Kind::Plane:
        return std::make_unique<Plane>(std::move(place), object.corners, material, id);
    case ObjectDesc::Kind::InfinitePlane:
        return std::make_unique<InfinitePlane>(std::move(place), material, id);
    case ObjectDesc::Kind::Disk:
        return std::make_unique<Disk>(std::move(place), object.radius, material, id);
    case ObjectDesc::Kind::Cylinder:
        return std::make_unique<Cylinder>(std::move(place), object.radius, object.caps, material,
                                          id);
    case ObjectDesc::Kind::Cone:
        return std::make_unique<Cone>(std::move(place), object.radius, object.topRadius,
                                      object.caps, material, id);
    case ObjectDesc::Kind::Mesh: break;
    }
    fail(ErrorKind::Input, "error: an object of a kind that is not known");
}
