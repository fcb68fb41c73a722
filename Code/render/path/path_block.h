// PathBlock: what goes into and comes out of the scattering of sixteen points, by column. The
// stage in lanes (path_in_lanes.h) knows numbers only; path.cpp brings them here and takes them
// away.
#pragma once

#include "render/path/lobe_block.h"
#include "render/point_block.h"

#include <cstddef>

class PathLights;

// Two random numbers in [0,1) for each of sixteen points.
struct alignas(64) NumberPairs {
    LobeBlock::Lane u, v;
};
struct PathNumbers {
    NumberPairs choice; // which light, and which lobe
    NumberPairs onLight, direction;
    NumberPairs goesOn; // whether the path does; whether it goes straight through the point
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
