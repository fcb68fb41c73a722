// What shading over lobes does by the register: the stages that know numbers only.
#pragma once

#include "render/path/whitted_block.h"

#include <cstddef>
#include <cstdint>
#include <span>

// All take the points of block.points, whose lobes are those of `lobes`; the numbers of others
// stay.
struct ShadingKernel {
    // The rest of the `used` points of a block whose surfaces are known, seen along `dirs` (of all
    // sixteen), but for pictures that bend normals. `litOutside`: those whose materials are.
    // Returns the points whose normals face away from the eye and have to be turned.
    unsigned (*see)(PointBlock& block, const Vec3* dirs, unsigned used,
                    unsigned litOutside) = nullptr;
    // Paths: the light of one lamp, and a direction.
    void (*scatter)(const PathLights& lights, const PointBlock& points, const LobeBlock& lobes,
                    PathBlock& block) = nullptr;
    // The samples of all these lamps.
    void (*lamps)(const PathLights& lights, std::span<LampQueue> lamps, const PointBlock& points,
                  const LobeBlock& lobes, const LampBlock& block) = nullptr;
    // The rays of all lobes, by numbers.choice.v and numbers.direction of the block.
    void (*bounce)(const PointBlock& points, const LobeBlock& lobes, const PathBlock& block,
                   BounceQueue& out) = nullptr;
    // block.weight becomes the part of even light that diffuse lobes send on.
    void (*ambient)(const PointBlock& points, const LobeBlock& lobes, PathBlock& block) = nullptr;
};
