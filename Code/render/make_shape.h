// ObjectDesc -> Shape. A new shape is one case here.
#pragma once

#include "base/motion.h"
#include "desc/scene_desc.h"
#include "shape/shape.h"

#include <memory>

// Any kind but Mesh, whose geometry is shared (merge.h). `place` is normalisedFromObject.
std::unique_ptr<const Shape> makeShape(const ObjectDesc& object, MovingTransform place,
                                       std::uint32_t material, std::uint32_t id);
