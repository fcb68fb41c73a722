// LightDesc -> Light, and the body of a lamp that can be seen. A new light is one case here.
#pragma once

#include "desc/scene_desc.h"
#include "light/light.h"
#include "render/frame.h"
#include "shape/shape.h"

#include <memory>

std::unique_ptr<const Light> makeLight(const LightDesc& desc, const SceneFrame& frame);

// The shape of a lamp that has a size, its front where the light goes; nullptr for the others and
// for suns.
std::unique_ptr<const Shape> makeLampBody(const LightDesc& desc, const SceneFrame& frame,
                                          std::uint32_t material, std::uint32_t id);
