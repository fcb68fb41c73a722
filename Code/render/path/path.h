// Path tracing (Kajiya 1986): each sample follows one path. At each point a lamp is chosen and a
// place on it (next event estimation), and the same light is found by rays that lobes have sampled;
// both are weighted by the power heuristic (Veach 1997).
#pragma once

#include "render/integrator.h"

void integratePath(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                   RayCounts& counts, std::uint64_t& cameraHits);
