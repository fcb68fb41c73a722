// What shading over lobes does by the register: the stages that know numbers only.
#pragma once

#include "render/path/whitted_block.h"

#include <cstddef>
#include <cstdint>

// All take the points of block.points, whose lobes are those of `lobes`; the numbers of others
// stay.
struct ShadingKernel {
    // Paths: the light of one lamp, and a direction.
    void (*scatter)(const PathLights& lights, const PointBlock& points, const LobeBlock& lobes,
                    PathBlock& block) = nullptr;
    // One sample of this lamp.
    void (*lamp)(const PathLights& lights, std::uint32_t light, const PointBlock& points,
                 const LobeBlock& lobes, LampBlock& block) = nullptr;
    // Samples lobe number `lobe`, by numbers.lobe, bsdfU and bsdfV of the block. `transmits`: of
    // lobes that do both.
    void (*bounce)(const PointBlock& points, const LobeBlock& lobes, std::size_t lobe,
                   bool transmits, PathBlock& block) = nullptr;
    // block.weight becomes the part of even light that diffuse lobes send on.
    void (*ambient)(const PointBlock& points, const LobeBlock& lobes, PathBlock& block) = nullptr;
};
