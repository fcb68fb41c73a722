// The light that a shining surface without a mesh is.
#pragma once

#include "base/transform.h"
#include "base/vec.h"
#include "desc/scene_desc.h"
#include "light/light_row.h"

#include <optional>

// Balls, disks and rectangles that stand still and keep their form can be sampled. Nothing for
// others, which are found by rays alone. `back`: the row of the side that normals point away from;
// nothing for balls.
std::optional<LightRow> makeEmitterRow(const ObjectDesc& desc, const Transform& place, Rgb radiance,
                                       bool back);
