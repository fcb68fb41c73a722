// What a worker keeps of the paths of a chunk of samples, between the waves of path.cpp.
#pragma once

#include "base/math.h"
#include "base/ray_cone.h"
#include "integrate/batch.h"
#include "integrate/checkers.h"
#include "integrate/lobe_block.h"
#include "integrate/shading_kernel.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

// What a ray of a path has behind it. Bounces are counted by kind, as Blender limits them.
struct PathState {
    // Density per steradian of the direction, for hits on lights; 0 where no light was sampled for
    // the same answer: camera rays, and those of single directions.
    float pdf = 0;
    // The least density of the bounces behind it; single directions leave it.
    float leastPdf = kInfinityF;
    Vec3 p, n; // the point where the direction was sampled, and its normal (0: both sides)
    std::uint16_t diffuse = 0, glossy = 0, transmission = 0, transparent = 0; // limits go to 1024
    int bounces() const { return diffuse + glossy + transmission; }
    // The least alpha of facets that it meets, by Cycles' Filter Glossy of `radius`.
    float leastAlpha(float radius) const {
        return leastPdf < radius ? 0.5f * std::sqrt(1 - leastPdf / radius) : 0;
    }
    RayCone cone;        // only where pictures are filtered
    bool isLast = false; // sees lights only, also through what is not opaque
};

struct PathMemory {
    std::vector<PathState> states, nextStates; // of memory.rays and memory.next
    // Points whose materials have lobes, by the kinds of these and then by number.
    std::vector<std::uint32_t> alike, alikeStarts;
    std::vector<std::uint16_t> signatures; // by point: LobedMaterial::signature
    std::vector<MaterialMix> mixes;        // by point; empty without checkers
    PointBlock gathered{};                 // of points that are not a block
    LobeBlock lobes{};
    PathBlock block{};
    WhittedBlock whitted{};
    SkyBlock sky{};
    BounceQueue bounces{};
    // The material whose numbers `lobes` has for all points, if they are of one.
    std::uint32_t filledWith = kMixed;
    static constexpr std::uint32_t kMixed = 0xffffffffu;
    std::array<RayBatch, 8> lampRays; // `sample`: the point
    // The first origins in each of them that are in one place.
    struct Origins {
        Vec3 place;
        std::size_t count = 0;
    };
    std::array<Origins, 8> lampOrigins;
    std::array<LampQueue, 8> lamps{};
    std::vector<NumberPairs> places;  // on lamps, lamp by lamp and sample by sample
    std::vector<Rgb> sums;            // by point: light on its way to the sample
    std::vector<std::uint32_t> order; // of memory.next: by point and branch
    PathBatch sorted;                 // rays of a block on their way into that order
    std::vector<PathState> sortedStates;
    RayBatch shadowRays; // `sample`: the slot; `weight`: the light of a sample that arrives
};
