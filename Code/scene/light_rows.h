// What a light of a description is as numbers in lanes.
#pragma once

#include "base/transform.h"
#include "base/vec.h"
#include "desc/scene_desc.h"
#include "light/light_row.h"
#include "scene/frame.h"

#include <optional>

// Lengths are in the frame's units, intensities scaled to them. A lamp without an area, or a black
// one, is dark: LightBounds::isDark() of its boundsOf() (light/tree/light_bounds.h).
LightRow lightRow(const LightDesc& desc, const SceneFrame& frame);

// The light that a shining surface without a mesh is.

// Balls, disks and rectangles that stand still and keep their form can be sampled. Nothing for
// others, which are found by rays alone. `back`: the row of the side that normals point away from;
// nothing for balls.
std::optional<LightRow> makeEmitterRow(const ObjectDesc& desc, const Transform& place, Rgb radiance,
                                       bool back);
