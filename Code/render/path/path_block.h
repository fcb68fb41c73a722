// PathBlock: what goes into and comes out of the scattering of sixteen points, by column. The
// stage in lanes (path_in_lanes.h) knows numbers only; path.cpp brings them here and takes them
// away.
#pragma once

#include "render/path/lobe_block.h"
#include "render/point_block.h"

#include <cstddef>

class PathLights;

// Random numbers of a point, each in [0,1): which light, where on it, which lobe, which direction.
struct alignas(64) PathNumbers {
    LobeBlock::Lane light, lightU, lightV, lobe, bsdfU, bsdfV, roulette, spare;
};

struct alignas(64) PathBlock {
    static constexpr std::size_t kPoints = LobeBlock::kPoints;
    using Lane = LobeBlock::Lane;
    // In. `throughput`: of the path up to the point; `eta`: see LobeNumbers.
    alignas(64) Lane throughput[3], eta;
    unsigned points = 0; // bits of those that are asked
    PathNumbers numbers;
    // Out: light from the chosen lamp, if nothing is in between. The ray to it has a unit
    // direction.
    alignas(64) Lane toLamp[3], lampEnd, lampOrg[3], fromLamp[3];
    unsigned lit = 0;  // bits of those with light
    unsigned open = 0; // of these: the lamp casts no shadow
    // Out: how the path goes on; the throughput is multiplied by `weight`. `pdf` is 0 for single
    // directions.
    alignas(64) Lane dir[3], org[3], weight[3], pdf;
    unsigned scattered = 0, single = 0, diffuse = 0, transmitted = 0;
};
