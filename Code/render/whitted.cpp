// Whitted ray tracing (Whitted 1980) with distributed effects (Cook et al. 1984), in waves: all
// rays of one depth are traced together, shaded together, and spawn the next wave. The sums of a
// sample run over waves, and inside a wave over rays in the order of their parents, first what
// needs no shadow rays and then the lamps, so they do not depend on how samples are grouped.
#include "render/waves/bounces.h"
#include "render/waves/glow.h"
#include "render/waves/lamps.h"
#include "render/waves/points.h"
#include "render/waves/seen_lamps.h"

#include <utility>

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits) {
    const Steps& steps = context.steps;
    counts.camera += chunk.cameraRays.size();
    if (steps.bounces) memory.media = context.media;
    const PathBatch* rays = &chunk.cameraRays;
    for (int depth = 0; !rays->empty(); ++depth) {
        const Wave wave{context, *rays, depth, chunk, memory, counts};
        closest(context.scene, *rays, memory.hits);
        compiledFor(
            [&]<bool kTextures, bool kSeeThrough> { findPoints<kTextures, kSeeThrough>(wave); },
            steps.textures, steps.seeThrough);
        if (depth == 0) cameraHits += memory.points.count;
        if (!context.scene.seenLamps().isEmpty()) addSeenLamps(wave);
        compiledFor(
            [&]<bool kLampBodies, bool kSeeThrough> { addGlow<kLampBodies, kSeeThrough>(wave); },
            steps.lampBodies, steps.seeThrough);
        compiledFor(
            [&]<bool kSoftLamps, bool kSeeThrough> { addLamps<kSoftLamps, kSeeThrough>(wave); },
            steps.softLamps, steps.seeThrough);
        if (!steps.bounces && !steps.seeThrough) return;
        compiledFor(
            [&]<bool kBounces, bool kSeeThrough> { spawnBounces<kBounces, kSeeThrough>(wave); },
            steps.bounces, steps.seeThrough);
        std::swap(memory.rays, memory.next);
        rays = &memory.rays;
    }
}
