// Wave: the rays of one depth of a chunk of samples, as the stages of the loop in whitted.cpp see
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

    // Then sums do not depend on the order of the rays.
    bool hasOneRayPerSample() const { return depth == 0 || !context.steps.branches; }
    void add(std::uint32_t slot, Rgb radiance) const { chunk.radiance[slot] += radiance; }
    // The slot of the sample that a point belongs to.
    std::uint32_t slotOf(std::uint32_t point) const { return memory.points.slot[point]; }
};
