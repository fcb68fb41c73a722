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
    // Whitted pictures: the samples of all these lamps, and the rays of lobes.
    void (*whitted)(const PathLights& lights, std::span<LampQueue> lamps, const PointBlock& points,
                    const LobeBlock& lobes, WhittedBlock& block, BounceQueue& bounces) = nullptr;
};
