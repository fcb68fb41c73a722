// What a kernel does for surfaces; the scalar one leaves them to the shapes.
#pragma once

#include "accel/kernels/still_surfaces.h"
#include "accel/kernels/triangle_surfaces.h"

struct SurfaceLanes {
    StillSurfacesFn stills = nullptr;
    TriangleSurfacesFn triangles = nullptr;
};
