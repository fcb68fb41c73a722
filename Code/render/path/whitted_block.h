// What Whitted pictures want of sixteen points in lanes: the light of one sample of a lamp, the
// rays of one lobe, and the answer to even light.
#pragma once

#include "render/path/path_block.h"

struct alignas(64) LampBlock {
    static constexpr std::size_t kPoints = LobeBlock::kPoints;
    using Lane = LobeBlock::Lane;
    // In. `throughput`, `eta`, `points`: as in PathBlock; u, v: the place on the lamp.
    alignas(64) Lane throughput[3], eta, u, v;
    unsigned points = 0;
    unsigned litOutside = 0; // of these: seen from the inside, lit on the outside
    float samples = 1;       // how many the lamp has
    bool besideRays = true;  // rays of rough lobes find some of its light
    // Out: light of the sample, if nothing is in between, and the shadow ray: from the point to the
    // lamp, or, for lamps in one place, from there to the point.
    alignas(64) Lane light[3], org[3], dir[3], end;
    unsigned lit = 0;
};
