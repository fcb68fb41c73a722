// Wave: the rays of one depth of a chunk of samples, as the stages of the loops over depths see
// it. Every stage goes over the whole wave before the next one starts, so that its code and data
// stay in the cache; what a stage leaves to the next ones is in WaveMemory.
#pragma once

#include "render/integrator.h"

struct Wave {
    const IntegratorContext& context;
    const PathBatch& rays;
    int depth; // 0: camera rays, of which every sample has exactly one
    SampleChunk& chunk;
    WaveMemory& memory;
    RayCounts& counts;

    void add(std::uint32_t slot, Rgb radiance) const { chunk.radiance[slot] += radiance; }
};
