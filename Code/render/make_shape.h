// ObjectDesc -> Shape. A new shape is one case here.
#pragma once

#include "base/motion.h"
#include "desc/scene_desc.h"
#include "shape/shape.h"

#include <memory>
#include <span>

// Any kind but Mesh, whose geometry is shared (merge.h). `place` is normalisedFromObject; there is
// at least one material, two for a checkerboard.
std::unique_ptr<const Shape> makeShape(const ObjectDesc& object, const MovingTransform& place,
                                       std::span<const std::uint32_t> materials, std::uint32_t id);

// The shape, of which only some sides can be seen.
std::unique_ptr<const Shape> withSides(std::unique_ptr<const Shape> shape, ObjectDesc::Sides sides);
