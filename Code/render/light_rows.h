// What a light of a description is as numbers in lanes.
#pragma once

#include "desc/scene_desc.h"
#include "light/light_row.h"
#include "render/frame.h"

// Lengths are in the frame's units, intensities scaled to them. A lamp without an area, or a black
// one, is dark: LightBounds::isDark() of its boundsOf() (light/tree/light_bounds.h).
LightRow lightRow(const LightDesc& desc, const SceneFrame& frame);
