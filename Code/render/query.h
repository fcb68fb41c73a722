// The questions that integrators ask about batches of rays. Kernels live behind them; the answers
// are functions of scene and ray alone.
#pragma once

#include "render/batch.h"
#include "render/scene.h"

#include <vector>

// hits[i] is the nearest hit of ray i (Hit::isHit() false: none). Resizes hits.
void closest(const Scene& scene, const RayBatch& rays, std::vector<Hit>& hits);

// transmittance[i]: the part of the light that passes along ray i between tMin and tMax. Black
// where an opaque surface is in between, white where nothing is. Resizes transmittance.
void transmitted(const Scene& scene, const RayBatch& rays, std::vector<Rgb>& transmittance);
