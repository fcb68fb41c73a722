// What rays of a wave do at surfaces: what is on both sides, and which branch of the tree of rays
// they are.
#pragma once

#include "render/waves/wave.h"
#include "sample/hash.h"

namespace waves {

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
