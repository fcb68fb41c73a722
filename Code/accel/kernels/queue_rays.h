// W rays of the queue, by columns: what its steps read.
#pragma once

#include "accel/kernels/kernels.h"
#include "accel/kernels/key_range.h"
#include "accel/kernels/ray_lanes.h"
#include "base/math.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <cstddef>
#include <cstdint>

LANES_BEGIN

enum class Query { Closest, Any };

// What the steps of W rays read: RaySetup of accel/ray_setup.h by columns.
struct alignas(64) RayBlock {
    float r[3][W], nearOffset[3][W], farOffset[3][W]; // slabs of boxes by axis, in z
    std::uint32_t nearPlane[3][W];                    // where in a node, in bytes
    float zCut[W];
    // Triangles: origin and coordinates in the order lateral x, lateral y, depth.
    float origin[3][W];
    std::uint32_t axis[3][W];   // where in a leaf, in bytes
    float shearX[W], shearY[W]; // the slopes, for depths without the sign of the direction
    float sign[W];              // of the direction along z
    float lateralError[W];      // of a vertex in the ray's frame, 4 units of the space's size
    float dirX[W], dirY[W], dz[W];
    float key[W], below[W], tMax[W]; // of the best hit; see KeyRange of shape/triangle_queries.h
    std::uint32_t stackTop[W], bottom[W]; // its stack: see queue_slots.h
    std::uint32_t triangle[W], ray[W];
    std::uint32_t bestLeaf[W], bestLane[W]; // where the triangle is
    float depth[W];                         // nearest hits: the best one is not nearer
    std::uint32_t open;                     // lanes whose best hit has no key yet
    std::uint32_t count, live;              // rays at the start and now
    bool inARow;                            // W rays that follow each other in the batch
};

// What the answers of W rays need, and which hits count.
template <Query Q>
void setUpAnswers(const RayColumns& columns, const RayAxes& axes, std::size_t count, RayBlock& b) {
    b.inARow = columns.inARow;
    axes.dz.store(b.dz);
    columns.tMax.store(b.tMax);
    // Keys that count are in (above, below); see KeyRange of shape/triangle_queries.h.
    const Floats above = keyAbove(columns.tMax, axes.dz);
    (Q == Query::Any ? above : Floats(0.0f)).store(b.key);
    keyBelow(columns.tMin, axes.dz).store(b.below);
    depthCuts(above).store(b.zCut);
    Ints(TriangleHit::kNone).store(b.triangle);
    Floats(kInfinityF).store(b.depth);
    b.open = 0;
    b.count = static_cast<std::uint32_t>(count);
}

// What triangles are asked with.
inline void setUpTriangles(const RayColumns& columns, const RayAxes& axes, float extent,
                           RayBlock& b) {
    axes.lateralX(columns.org).store(b.origin[0]);
    axes.lateralY(columns.org).store(b.origin[1]);
    axes.dominant(columns.org).store(b.origin[2]);
    const auto place = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        constexpr std::uint32_t row = W * 4;
        return select(axes.alongZ, Ints(z * row),
                      select(axes.alongY, Ints(y * row), Ints(x * row)));
    };
    place(1, 2, 0).store(b.axis[0]);
    place(2, 0, 1).store(b.axis[1]);
    place(0, 1, 2).store(b.axis[2]);
    (axes.Sx * axes.sign).store(b.shearX);
    (axes.Sy * axes.sign).store(b.shearY);
    axes.sign.store(b.sign);
    (axes.errorIn(extent) * Floats(0.125f)).store(b.lateralError);
    axes.lateralX(columns.dir).store(b.dirX), axes.lateralY(columns.dir).store(b.dirY);
}

// Fills the block. Returns the lanes of the rays that isTraceable().
template <Query Q>
unsigned setUpRays(const RaySpan& rays, const std::uint32_t* order, std::size_t count, float extent,
                   RayBlock& b) {
    const RayColumns columns = loadRays(rays, order, count, b.ray);
    const RayLanes lanes(columns, extent);
    const auto storeSlab = [&](std::size_t axis) {
        lanes.r[axis].store(b.r[axis]);
        lanes.nearOffset[axis].store(b.nearOffset[axis]);
        lanes.farOffset[axis].store(b.farOffset[axis]);
        const auto plane = [&](std::uint32_t upper) {
            return Ints(static_cast<std::uint32_t>(axis * 2 + upper) * W * 4);
        };
        select(lanes.r[axis] < Floats(0.0f), plane(1), plane(0)).store(b.nearPlane[axis]);
    };
    storeSlab(0), storeSlab(1), storeSlab(2);
    setUpTriangles(columns, lanes, extent, b);
    setUpAnswers<Q>(columns, lanes, count, b);
    return lanes.traceable & ((1u << count) - 1);
}

LANES_END
