// What can be told of the camera's place and target once all shapes are there.
#pragma once

#include "camera/camera.h"
#include "scene/shape_set.h"

#include <optional>

// The depth at which rays of a camera with a shared origin have to start so that none begins on a
// surface, where rounding would decide on which side of it; 0 where no surface is that near.
double clearDepth(const ShapeSet& shapes, const Camera& camera);

// How far floats are apart, in widths of a pixel, where the middle of a picture of width x height
// pixels shows something; nothing where it shows nothing.
std::optional<double> spacingInPixels(const ShapeSet& shapes, const Camera& camera, int width,
                                      int height);
