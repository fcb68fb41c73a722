// What shading makes of a block of points, a register of them at a time: the numbers of
// shadeSurface() and of fillBlocks(), operation by operation and so bit by bit. Knows numbers only;
// points.h and fill_blocks.h bring them here.
#pragma once

#include "base/bounds.h"
#include "base/vec.h"
#include "material/material.h"
#include "render/point_block.h"
#include "render/waves/lamp_lanes.h"

// Where rays go, one after the other; up to sixteen places behind the last one are overwritten.
struct RayPlaces {
    Vec3 *org, *dir;
    float* tMax;
    Rgb* weight;
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
    // The same of sixteen points that have a material each.
    void (*paintEach)(const Material* const* materials, LitBlock& lit) = nullptr;
    // Of sixteen samples that follow each other: radiance[i] += weights[i] * glow[i].
    void (*glow)(const Rgb* weights, const Rgb* glow, Rgb* radiance) = nullptr;
    // Sums begin with the radiance of sixteen samples that follow each other, and become it.
    void (*take)(const Rgb* radiance, LightSums& sums) = nullptr;
    void (*give)(const LightSums& sums, Rgb* radiance) = nullptr;
    // Or are added to it.
    void (*addRow)(const LightSums& sums, Rgb* radiance) = nullptr;
    // The box around the used points and where they are lifted to.
    Bounds (*bounds)(const PointBlock& block, unsigned used) = nullptr;
    // Directions and ends of the rays from a lamp to some points.
    void (*aim)(const LitByLamp& by, unsigned points, const RayPlaces& out) = nullptr;
    // Adds a lamp's light to the sums of the points that it reaches: of those of `shadowed` there
    // is a ray for each, in order, and sixteen numbers, not 0 for a hidden one. Others get nothing:
    // they stay as they are, as no sum is ever -0.
    void (*add)(const LitByLamp& by, unsigned shadowed, const std::uint8_t* hidden,
                LightSums& sums) = nullptr;
};
