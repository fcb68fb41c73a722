// What a kernel does for surfaces; the scalar one leaves them to the shapes.
#pragma once

#include "accel/kernels/round_surfaces.h"
#include "accel/kernels/triangle_surfaces.h"

struct Kernel;

struct SurfaceLanes {
    RoundSurfacesFn round = nullptr;
    TriangleSurfacesFn triangles = nullptr;
};
SurfaceLanes surfaceLanes(const Kernel& kernel);
