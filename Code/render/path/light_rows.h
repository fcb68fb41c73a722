// The rows of lights that a description means, in the frame of the scene.
#pragma once

#include "base/transform.h"
#include "base/vec.h"
#include "desc/scene_desc.h"
#include "light/light_row.h"
#include "render/frame.h"

#include <optional>

// Nothing where the lamp is black or has no size.
std::optional<LightRow> makeLightRow(const LightDesc& desc, const SceneFrame& frame);
// A surface without a mesh that can be sampled where it emits: balls, disks and rectangles that
// stand still and keep their form. Nothing for others, which are found by rays alone.
// `back`: the row of the side that normals point away from; nothing for balls.
std::optional<LightRow> makeEmitterRow(const ObjectDesc& desc, const Transform& place, Rgb radiance,
                                       bool back);
