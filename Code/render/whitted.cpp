// Whitted ray tracing (Whitted 1980) with distributed effects (Cook et al. 1984), in waves: all
// rays of one depth are traced together, shaded together, and spawn the next wave. The sums of a
// sample run over waves, and inside a wave over rays in the order of their parents, first what
// needs no shadow rays and then the lamps, so they do not depend on how samples are grouped.
#include "render/waves/bounces.h"
#include "render/waves/glow.h"
#include "render/waves/lamps.h"
#include "render/waves/points.h"

#include <array>
#include <utility>

namespace {

template <Steps kSteps>
void runWaves(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
              RayCounts& counts, std::uint64_t& cameraHits) {
    counts.camera += chunk.cameraRays.size();
    if constexpr (kSteps.bounces) memory.media = context.media;
    const PathBatch* rays = &chunk.cameraRays;
    for (int depth = 0; !rays->empty(); ++depth) {
        const Wave wave{context, *rays, depth, chunk, memory, counts};
        closest(context.scene, *rays, memory.hits);
        findPoints<kSteps>(wave);
        if (depth == 0) cameraHits += memory.points.count;
        addGlow<kSteps>(wave);
        addLamps<kSteps>(wave);
        if constexpr (!kSteps.bounces && !kSteps.seeThrough) return;
        spawnBounces<kSteps>(wave);
        std::swap(memory.rays, memory.next);
        rays = &memory.rays;
    }
}

using Integrate = decltype(&runWaves<Steps{}>);
template <std::size_t... kIndices>
constexpr std::array<Integrate, sizeof...(kIndices)> compiled(std::index_sequence<kIndices...>) {
    return {&runWaves<kCompiledSteps[kIndices]>...};
}
constexpr auto kCompiledWaves = compiled(std::make_index_sequence<kCompiledSteps.size()>());

} // namespace

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits) {
    kCompiledWaves[context.compiledSteps](context, chunk, memory, counts, cameraHits);
}
