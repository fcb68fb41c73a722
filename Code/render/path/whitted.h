// Whitted ray tracing (Whitted 1980) with distributed effects (Cook et al. 1984) over lobes: every
// lamp is asked at every point, and every lobe but diffuse ones is followed. Rough lobes and lamps
// with a size share their light by the power heuristic (Veach 1997).
#pragma once

#include "render/integrator.h"

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits);
