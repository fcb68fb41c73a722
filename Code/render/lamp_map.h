// LampMap: the solids that a point lamp sees in each direction, nearest first, so that most shadow
// rays need no walk through the tree (Haines and Greenberg, "The Light Buffer", IEEE CG&A 6, 1986).
// Directions are the cells of a picture of the solids that the lamp takes. What the map says is
// sure; where it can't tell, a ray has to be asked.
#pragma once

#include "accel/kernels/kernels.h"
#include "base/raw_vector.h"
#include "light/point_emission.h"
#include "render/occluders.h"
#include "render/waves/lamp_lanes.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct LampMap {
    // Half a line of the cache.
    struct alignas(32) Hull {
        Vec3 centre;
        float radius;
        Vec3 axis;
        float halfLength; // 0: a ball
    };
    // A hull is negative in radius if what is in it is not nearly all of it, and hides nothing for
    // sure; else the inner radius is this part.
    static constexpr float kInner = 1 - 0x1p-17f;
    static constexpr std::size_t kMostOthers = 4;

    Vec3 lamp;
    // The picture's axes; a direction d is in the column (right d / ahead d) scale[0] + offset[0]
    // and in a row alike.
    Vec3 right, up, ahead;
    float scale[2], offset[2];
    float leastCosine; // of directions of the picture to `ahead`
    int logCells = 0;  // columns and rows
    float slack = 0;   // that covers rounding, as in solids_hulls.inl
    // lists[starts[cell]] up to starts[cell + 1]: what the rays of a cell may meet, the nearest
    // first. Each is the number of a hull, and above kHullBits in which step from the lamp it
    // starts.
    static constexpr int kHullBits = 20;
    RawVector<std::uint32_t> starts, lists;
    std::vector<std::uint32_t> hullOf; // by shape; kNoHull: it is not in the picture
    static constexpr std::uint32_t kNoHull = 0xffffffffu;
    float firstStep, perStep;
    RawVector<Hull> hulls;
    std::vector<Occluder> others; // shapes that are not in the picture

    float stepOf(float reach) const { return (reach - firstStep) * perStep; }
    std::size_t cells() const { return std::size_t{1} << logCells; }
};

// Null: none can be made, or it would cost more than it saves for so many shadow rays.
std::shared_ptr<const LampMap> makeLampMap(const ShapeSet& shapes, const PointEmission& lamp,
                                           double rays);

// Looks for the points of blocks that are `unsure`: those that something hides from the lamp are no
// longer lit, and unsure are those of which only a ray can tell.
using AskLampMapFn = void (*)(const LampMap& map, std::span<const LitBlock> blocks,
                              std::span<LitByLamp> by);
// Null for the scalar kernel.
AskLampMapFn askLampMap(const Kernel& kernel);
