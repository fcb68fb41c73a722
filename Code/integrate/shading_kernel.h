// PathBlock: what goes into and comes out of the scattering of sixteen points, by column. The
// stage in lanes (path_in_lanes.h) knows numbers only; path.cpp brings them here and takes them
// away.
#pragma once

#include "base/math.h"
#include "integrate/lobe_block.h"
#include "integrate/point_block.h"

#include <cstddef>
#include <cstdint>
#include <span>

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

// What Whitted pictures want of sixteen points in lanes: shadow rays to lamps with the light of
// their samples, the rays of one lobe, and the answer to even light.

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

// How lamps were sampled beside the rays of lobes: one was chosen by the tree of lights, or each of
// them has so many samples.
struct LampSampling {
    bool isOneChosen = true;
    float samples = 1;
};

// Rays that met nothing, where the sky is a lamp.
struct alignas(64) SkyBlock {
    static constexpr std::size_t kRays = 16;
    using Lane = float[kRays];
    // In: their directions, of any length; where they come from, and the normal there (0: both sides
    // are lit); the density of their directions, 0 for single ones.
    alignas(64) Lane dir[3] = {}, p[3] = {}, n[3] = {}, pdf = {};
    // Out: what part of the sky's radiance each adds, by the power heuristic.
    alignas(64) Lane part;
};

// What shading over lobes does by the register: the stages that know numbers only.

// All take the points of block.points, whose lobes are those of `lobes`; the numbers of others
// stay.
struct ShadingKernel {
    // The rest of the `used` points of a block whose surfaces are known, seen along `dirs` (of all
    // sixteen, of any length). `litOutside`: those whose materials are. `bent`: those whose normals
    // are bent; block.n has them, on the outside. Returns the points whose normals face away from
    // the eye and have to be turned.
    unsigned (*see)(PointBlock& block, const Vec3* dirs, unsigned used, unsigned litOutside,
                    unsigned bent) = nullptr;
    // Paths: the light of one lamp, and a direction.
    void (*scatter)(const PathLights& lights, const PointBlock& points, const LobeBlock& lobes,
                    PathBlock& block) = nullptr;
    // Whitted pictures: the samples of all these lamps, and the rays of lobes.
    void (*whitted)(const PathLights& lights, std::span<LampQueue> lamps, const PointBlock& points,
                    const LobeBlock& lobes, WhittedBlock& block, BounceQueue& bounces) = nullptr;
    // The sky as a lamp, of the first `count` rays of a block; others get any part.
    void (*sky)(const PathLights& lights, const LampSampling& sampling, SkyBlock& block,
                std::size_t count) = nullptr;
};
