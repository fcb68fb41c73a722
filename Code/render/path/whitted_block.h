// What Whitted pictures want of sixteen points in lanes: shadow rays to lamps with the light of
// their samples, the rays of one lobe, and the answer to even light.
#pragma once

#include "base/math.h"
#include "render/path/path_block.h"

#include <cstddef>
#include <cstdint>

struct alignas(64) WhittedBlock {
    static constexpr std::size_t kPoints = LobeBlock::kPoints;
    using Lane = LobeBlock::Lane;
    // In. `throughput`, `eta`, `points`: as in PathBlock.
    alignas(64) Lane throughput[3], eta;
    unsigned points = 0;
    unsigned litOutside = 0;       // of these: seen from the inside, lit on the outside
    bool besideRays = true;        // rays of rough lobes find some of the lamps' light
    bool takesEvenLight = false;   // `evenLight` is wanted
    bool sendsRays = false;        // rays of lobes are wanted
    std::uint32_t number[kPoints]; // in the wave
    NumberPairs choice, direction; // for rays; choice.v is of the lobe's own
    // Out: what of even light from everywhere diffuse lobes send to the eye.
    alignas(64) Lane evenLight[3];
};

// A lamp, and its shadow rays: from each point to the lamp, or from where the lamp sits to the
// points.
struct LampQueue {
    std::uint32_t light = 0;
    std::uint32_t samples = 1;
    float share = 1;                     // of a sample, of the lamp's light
    const NumberPairs* places = nullptr; // on it, of each sample; null: all are at 0
    // Where the rays go to, with room for one register more than there are.
    struct {
        Vec3 *org, *dir; // org is left alone if rays start at the lamp
        float* end;
        std::uint32_t* point; // in the wave
        Rgb* light;           // that arrives if nothing is in between
    } to{};
    std::size_t rays = 0;
};

// The rays that lobes of sixteen points send, of each as many as it has lobes that reflect or
// transmit, and one register more.
struct BounceQueue {
    static constexpr std::size_t kMost = LobeBlock::kPoints * (2 * LobeBlock::kMost + 1);
    std::size_t rays = 0;
    Vec3 org[kMost], dir[kMost];
    Rgb weight[kMost];          // what throughput is multiplied by
    float pdf[kMost];           // per steradian; 0 for single directions
    std::uint8_t point[kMost];  // of the block
    std::uint8_t branch[kMost]; // 1 + 2 * lobe, and 1 more for what it transmits
    bool isBelow[kMost];        // leaves to the other side of the surface
};
