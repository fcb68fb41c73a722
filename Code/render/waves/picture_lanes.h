// Look-ups in pictures by the register: textures and the surroundings of the scene.
#pragma once

#include "render/waves/environment_lanes.h"
#include "render/waves/texture_lanes.h"

struct PictureLanes {
    TextureColorsFn texture = nullptr;
    EnvironmentColorsFn environment = nullptr;
};
