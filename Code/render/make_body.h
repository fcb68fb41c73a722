// The body of a lamp that can be seen.
#pragma once

#include "desc/scene_desc.h"
#include "render/frame.h"
#include "shape/shape.h"

#include <cstdint>
#include <memory>

// The shape of a lamp that has a size, its front where the light goes; nullptr for the others and
// for suns. Without `hasBack` rays pass through the back of a flat one.
std::unique_ptr<const Shape> makeLampBody(const LightDesc& desc, const SceneFrame& frame,
                                          std::uint32_t material, std::uint32_t id, bool hasBack);
