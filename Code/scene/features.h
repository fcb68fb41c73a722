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
