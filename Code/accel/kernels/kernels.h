// Kernels: the questions that batches of rays ask of one mesh, answered with vector instructions.
// Every answer is that of the scalar traversal with canonicalKey() of accel/triangle.h, bit for
// bit: kernels find the candidates in their own ways, and the canonical hit decides.
//
// The folder. .inl files are written for any number of lanes: the file of each instruction set
// (sse, avx2, avx512) includes region_includes.h, one simd_*.inl and then, in this order,
//   [isa].cpp         kernel, which includes key_range, barycentrics, stack, ray_lanes; for rays
//                     one by one: queue_rays, root_boxes, queue_*, lane_hits, handful (tiny
//                     trees), queue; for rays that go side by side: beam_shape, beam; for rays
//                     from one point: bundle_*, bundle
//   solids_[isa].cpp  ray_lanes, solids_columns_[isa], all_lanes; solids, which includes solids_*
//   placed_[isa].cpp  stack, ray_lanes, placed_mesh, placed
//   surface_lanes_[isa].cpp  vectors3, still_surfaces (with still_numbers, still_points),
//                     triangle_surfaces
// choose.cpp has the table of kernels and route.cpp deals the rays of a batch out to bundles and
// the others, of which beam.inl takes what it can and the queue the rest; solids.cpp does both for
// solids, placed.cpp has the table for placed meshes, which call back to a PlacedQuery.
// exact_hit.cpp decides what lanes leave open, in plain code. wide_build.cpp and build/ make the
// trees.
#pragma once

#include "accel/kernels/wide_tree.h"
#include "base/hit.h"
#include "base/ray_span.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

struct Kernel {
    const char* name;
    int width; // of its trees; 0: it has none, the scalar code of Mesh answers
    bool (*supported)();
    ClosestFn closest, closestFromPoint; // FromPoint: all rays of `order` start at the same point
    AnyFn any, anyFromPoint;
};

// Best first, the scalar one last. Which of them the CPU has is asked by supported().
std::span<const Kernel> allKernels();
std::vector<std::string> kernelNames();
// By name; "auto" is the best that the CPU supports. Fails for a name that is not in the table or
// not supported, and says which are.
const Kernel& chooseKernel(std::string_view name);

// Nearest hit with tMin < t <= tMax of every ray of the batch, kNone where there is none.
void closestHits(const Kernel& kernel, const WideMesh& mesh, const RaySpan& rays,
                 std::span<TriangleHit> hits);
// The same with u and v, as hits of shape `number`; a ray that meets nothing keeps t = tMax.
void closestHits(const Kernel& kernel, const WideMesh& mesh, const RaySpan& rays,
                 std::uint32_t number, std::span<Hit> hits);
// hidden[i]: is there a hit with tMin < t < tMax?
void anyHits(const Kernel& kernel, const WideMesh& mesh, const RaySpan& rays,
             std::span<std::uint8_t> hidden);
