// Kernels: the questions that batches of rays ask of one mesh, answered with vector instructions.
// Every answer is that of the scalar traversal with canonicalKey() of accel/triangle.h, bit for
// bit: kernels find the candidates in their own ways, and the canonical hit decides.
//
// Headers with LANES_BEGIN are written for any number of lanes (simd/region.h); the units of isa/
// include them all. For rays one by one: queue*, and handful for tiny trees; for rays that go side
// by side: beam*; for rays from one point: bundle*; for other shapes than triangles: solids*; for
// meshes that are placed and may move: placed*, which call back to a PlacedQuery. route.cpp deals
// the rays of a batch out to bundles and the others, of which beam.h takes what it can and the
// queue the rest; solids.cpp does both for solids. exact_hit.cpp decides what lanes leave open, in
// plain code. wide_build.cpp and build/ make the trees.
#pragma once

#include "accel/kernels/wide_tree.h"
#include "base/ray.h"
#include "isa/isa.h"

#include <cstdint>
#include <span>

// A mesh in the space that it is traced in.
struct WideMesh {
    const WideTree& tree;
    std::span<const Vec3> points;
    std::span<const std::array<std::uint32_t, 3>> triangles;
    float extent; // see RaySetup
    // Rays are bundled in trees up to this size: bundles remember hits by the lines of their
    // leaves, in 28 bits (16 GB). Tests lower it.
    std::size_t mostLinesForBundles = std::size_t{1} << 28;
};

struct TriangleHit {
    float t = kInfinityF;
    std::uint32_t triangle = kNone;
    static constexpr std::uint32_t kNone = 0xffffffffu;
};
static_assert(sizeof(TriangleHit) == 8 && sizeof(Hit) == 20); // bundles write pairs and rows

// Where nearest hits go, ray i's to element i: whole ones, with u and v, or t and triangle. The
// list that is null is not asked for.
struct HitLists {
    TriangleHit* brief = nullptr;
    Hit* whole = nullptr;
    std::uint32_t shape = 0; // of whole hits

    void miss(std::size_t ray, float tMax) const {
        if (whole != nullptr)
            whole[ray] = {.t = tMax};
        else
            brief[ray] = {};
    }
};

// Ray i is answered in element i of the list; only the rays in `order` are.
using ClosestFn = void (*)(const WideMesh& mesh, const RaySpan& rays,
                           std::span<const std::uint32_t> order, const HitLists& hits);
using AnyFn = void (*)(const WideMesh& mesh, const RaySpan& rays,
                       std::span<const std::uint32_t> order, std::uint8_t* hidden);

struct TriangleKernel {
    ClosestFn closest, closestFromPoint; // FromPoint: all rays of `order` start at the same point
    AnyFn any, anyFromPoint;
};

// Nearest hit with tMin < t <= tMax of every ray of the batch, kNone where there is none.
void closestHits(const Isa& isa, const WideMesh& mesh, const RaySpan& rays,
                 std::span<TriangleHit> hits);
// The same with u and v, as hits of shape `number`; a ray that meets nothing keeps t = tMax.
void closestHits(const Isa& isa, const WideMesh& mesh, const RaySpan& rays, std::uint32_t number,
                 std::span<Hit> hits);
// hidden[i]: is there a hit with tMin < t < tMax?
void anyHits(const Isa& isa, const WideMesh& mesh, const RaySpan& rays,
             std::span<std::uint8_t> hidden);
