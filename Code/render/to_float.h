// The step from the double precision of a SceneDesc to the floats of a Scene.
#pragma once

#include "base/vec.h"
#include "desc/scene_desc.h"

constexpr float toFloat(double x) { return static_cast<float>(x); }
constexpr Rgb toRgb(Rgbd c) { return {toFloat(c.r), toFloat(c.g), toFloat(c.b)}; }
