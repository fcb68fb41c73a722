// ObjectDesc -> Shape. A new shape is one case here.
#pragma once

#include "base/motion.h"
#include "desc/scene_desc.h"
#include "scene/frame.h"
#include "shape/shape.h"

#include <cstdint>
#include <memory>
#include <span>

// Any kind but Mesh, whose geometry is shared (merge.h). `place` is normalisedFromObject; there is
// at least one material, two for a checkerboard.
std::unique_ptr<const Shape> makeShape(const ObjectDesc& object, const MovingTransform& place,
                                       std::span<const std::uint32_t> materials, std::uint32_t id);

// The shape, of which only some sides can be seen.
std::unique_ptr<const Shape> withSides(std::unique_ptr<const Shape> shape, ObjectDesc::Sides sides);

// The body of a lamp that can be seen.

// The shape of a lamp that has a size, its front where the light goes; nullptr for the others and
// for suns. Without `hasBack` rays pass through the back of a flat one.
std::unique_ptr<const Shape> makeLampBody(const LightDesc& desc, const SceneFrame& frame,
                                          std::uint32_t material, std::uint32_t id, bool hasBack);
