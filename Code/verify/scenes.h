// Small scenes that together use everything that can be said without a picture file, made from
// random numbers: shapes, places and colours are other ones each time.
#pragma once

#include "verify/meshes.h"

#include <span>

namespace scenes {

struct Maker {
    const char* name;
    SceneDesc (*make)(meshes::Random&); // 32 x 24 pixels, a few samples each; valid
};
std::span<const Maker> makers();

} // namespace scenes
