// How many rays a picture will take, before it is made: a tree that is better but takes longer to
// build pays from some number on. Right within a factor of two or three, which is enough.
#pragma once

#include "desc/scene_desc.h"
#include "render/settings.h"

double predictedRays(const SceneDesc& desc, const RenderSettings& settings);
