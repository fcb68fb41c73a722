// What shading makes of a block of points, a register of them at a time: the numbers of
// shadeSurface(), of fillBlocks() and of plain mirrors, operation by operation and so bit by bit.
// Knows numbers only; points.h, fill_blocks.h and mirrors.h bring them here.
#pragma once

#include "base/vec.h"
#include "material/material.h"
#include "render/point_block.h"
#include "render/waves/lamp_lanes.h"

struct Kernel;

// Rays that leave the points of a block along their mirrored directions.
struct alignas(64) MirroredBlock {
    SurfaceBlock::Lane org[3], dir[3], weight[3];
};

// What the samples of a block's points have got so far.
struct alignas(64) LightSums {
    SurfaceBlock::Lane sum[3];
};

struct ShadeLanes {
    // The rest of the `used` points of a block whose surfaces are known, seen along `dirs` (of all
    // sixteen). `litOutside`: those whose materials are. Returns the points whose normals face away
    // from the eye and have to be turned.
    unsigned (*see)(PointBlock& block, const Vec3* dirs, unsigned used,
                    unsigned litOutside) = nullptr;
    // What lamps ask of points, but for their materials' numbers: `lit` gets bits of those that are
    // used, and for these the place, normals, weights[i], the way to the eye.
    void (*light)(const PointBlock& block, const Rgb* weights, unsigned used,
                  LitBlock& lit) = nullptr;
    // The numbers of a material that all of them have.
    void (*paint)(const Material& material, LitBlock& lit) = nullptr;
    // Rays that the used points mirror. Returns those that weigh enough.
    unsigned (*mirror)(const PointBlock& block, const Rgb* weights, const Rgb* mirrors,
                       unsigned used, float cutoff, MirroredBlock& out) = nullptr;
    // Adds a lamp's light to the sums of some points. Others get nothing: they stay, as no sum is
    // ever -0.
    void (*add)(const LitByLamp& by, unsigned points, LightSums& sums) = nullptr;
};
// Null for the scalar kernel.
ShadeLanes shadeLanes(const Kernel& kernel);
