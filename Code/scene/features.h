// What a scene needs, found by looking at it; --stats lists it, and what is not needed is skipped.
#pragma once

#include "desc/scene_desc.h"
#include "scene/settings.h"

#include <string>
#include <vector>

struct Feature {
    std::string name;
    bool needed = false;
    std::string reason; // why it is skipped
};
using Features = std::vector<Feature>;

Features featuresOf(const SceneDesc& desc, const CameraDesc& camera,
                    const RenderSettings& settings);

// How many rays a picture will take, before it is made: a tree that is better but takes longer to
// build pays from some number on. Right within a factor of two or three, which is enough.

double predictedRays(const SceneDesc& desc, const RenderSettings& settings);
