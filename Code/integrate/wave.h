// Wave: the rays of one depth of a chunk of samples, as the stages of the loops over depths see
// it. Every stage goes over the whole wave before the next one starts, so that its code and data
// stay in the cache; what a stage leaves to the next ones is in WaveMemory.
#pragma once

#include "base/raw_vector.h"
#include "integrate/context.h"
#include "integrate/path_memory.h"
#include "integrate/point_block.h"
#include "integrate/point_lists.h"
#include "integrate/samples.h"
#include "sample/hash.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Scratch memory of one worker, kept between chunks.
struct WaveMemory {
    PathBatch rays, next;
    std::vector<Hit> hits;
    PointBatch points;
    PointLists pointLists;
    MediumTree media;
    RawVector<Rgb> backgrounds; // that missed rays see
    RayBatch shadowRays;
    std::vector<std::uint8_t> hidden;
    std::vector<Rgb> transmittance;
    PathMemory path;
};

struct Wave {
    const IntegratorContext& context;
    const PathBatch& rays;
    int depth; // 0: camera rays, of which every sample has exactly one
    SampleChunk& chunk;
    WaveMemory& memory;
    RayCounts& counts;

    void add(std::uint32_t slot, Rgb radiance) const { chunk.radiance[slot] += radiance; }
};

namespace waves {

// ---- what rays see that meet no surface

// The radiance that each of the missed rays sees, in the order of their list. Without a picture
// around the scene it is the same for all, and the list is empty.
inline std::span<const Rgb> backgroundsOf(const Wave& wave) {
    const Scene& scene = wave.context.scene;
    const Environment* const environment = scene.environment();
    if (environment == nullptr) return {};
    const auto missed = std::span<const std::uint32_t>(wave.memory.points.missed)
                            .first(wave.memory.points.missedCount);
    RawVector<Rgb>& seen = wave.memory.backgrounds;
    if (seen.size() < missed.size()) seen.resize(missed.size());
    EnvironmentBlock block;
    for (std::size_t first = 0; first < missed.size(); first += EnvironmentBlock::kRays) {
        const std::size_t count = std::min(EnvironmentBlock::kRays, missed.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 dir = wave.rays.dir[missed[first + i]];
            block.dir[0][i] = dir.x, block.dir[1][i] = dir.y, block.dir[2][i] = dir.z;
        }
        wave.context.pictures.environment(*environment, block, count);
        for (std::size_t i = 0; i < count; ++i)
            seen[first + i] =
                scene.background(Rgb{block.color[0][i], block.color[1][i], block.color[2][i]});
    }
    return std::span(seen).first(missed.size());
}

// ---- what is on both sides of surfaces, and which branch of the tree of rays a ray is

// Random numbers of a branch of a ray: which, for Sampler.
constexpr std::uint32_t streamOf(std::uint32_t parent, std::uint32_t branch) {
    return low32(hash(parent, branch));
}

inline bool worthTracing(const Wave& wave, Rgb weight) {
    const float most = maxChannel(weight);
    return most > 0 && most >= wave.context.cutoff;
}

inline float iorOf(const Scene& scene, std::uint32_t material) {
    return material == MediumTree::kOutside ? 1.0f : scene.materials()[material].ior;
}

// What a ray is inside of on both sides of a point, and the ior on the eye's side over that on the
// other side.
struct Boundary {
    MediumTree::Inside before = MediumTree::kNothing, after = MediumTree::kNothing;
    float eta = 1;
};
inline Boundary boundaryAt(const Wave& wave, std::size_t k) {
    const Scene& scene = wave.context.scene;
    const PointBlock& block = wave.memory.points.at.block(k / PointBlock::kPoints);
    const std::size_t i = k % PointBlock::kPoints;
    const std::uint32_t number = block.material[i];
    const bool isFront = block.isFront(i);
    MediumTree& media = wave.memory.media;
    const MediumTree::Inside before = wave.rays.medium[wave.memory.points.ray[k]];
    const MediumTree::Inside after =
        isFront ? media.enter(before, number) : media.leave(before, number);
    const bool startedInside = !isFront && before == MediumTree::kNothing;
    const float iorHere = iorOf(scene, startedInside ? number : media.top(before));
    return {before, after, iorHere / iorOf(scene, media.top(after))};
}

} // namespace waves
