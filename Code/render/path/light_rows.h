// The rows of lights that a description means, in the frame of the scene.
#pragma once

#include "desc/scene_desc.h"
#include "light/light_row.h"
#include "render/frame.h"

#include <optional>

struct PoweredLight {
    LightRow row;
    float power = 0; // by which lights are chosen: about what it sends out, in all directions
};
// Nothing where the lamp is black or has no size.
std::optional<PoweredLight> makeLightRow(const LightDesc& desc, const SceneFrame& frame);
