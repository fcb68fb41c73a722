// All families of kernels for the instruction set of this unit (simd/region.h), and the tables of
// their functions.
#pragma once

#include "accel/kernels/boxed.h"
#include "accel/kernels/bundle.h"
#include "accel/kernels/placed_in_lanes.h"
#include "accel/kernels/queue.h"
#include "accel/kernels/solids_in_lanes.h"
#include "accel/kernels/still_surfaces_in_lanes.h"
#include "accel/kernels/surface_lanes.h"
#include "accel/kernels/triangle_surfaces_in_lanes.h"
#include "camera/camera_in_lanes.h"
#include "denoise/denoise_in_lanes.h"
#include "isa/isa.h"
#include "texture/pictures_in_lanes.h"

LANES_BEGIN

inline constexpr TriangleKernel kTriangles{closest, closestFromPoint, any, anyFromPoint};
inline constexpr SolidKernel kSolids{closestSolids, anySolids, nearerInBox};
inline constexpr PlacedKernel kPlaced{closestPlaced, anyPlaced};
inline constexpr SurfaceLanes kSurfaces{stillSurfaces, triangleSurfaces};

// An Isa of these functions.
constexpr Isa isaOf(const char* name, bool (*supported)(), const ShadingKernel* shading) {
    return {name,     W,          supported,  &kTriangles, &kSolids,
            &kPlaced, &kSurfaces, &kPictures, &kCamera,    shading, &kDenoise};
}

LANES_END
