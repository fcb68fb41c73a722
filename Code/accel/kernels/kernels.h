// Kernels: the questions that batches of rays ask of one mesh, answered with vector instructions.
// Every answer is that of the scalar traversal with canonicalKey() of accel/triangle.h, bit for
// bit: kernels find the candidates in their own ways, and the canonical hit decides.
#pragma once

#include "accel/kernels/wide_tree.h"
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
};

struct TriangleHit {
    float t = kInfinityF;
    std::uint32_t triangle = kNone;
    static constexpr std::uint32_t kNone = 0xffffffffu;
};
static_assert(sizeof(TriangleHit) == 8); // bundles write pairs

// hits[i] and hidden[i] belong to ray i; only those of the rays in `order` are written.
using ClosestFn = void (*)(const WideMesh& mesh, const RaySpan& rays,
                           std::span<const std::uint32_t> order, TriangleHit* hits);
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
// hidden[i]: is there a hit with tMin < t < tMax?
void anyHits(const Kernel& kernel, const WideMesh& mesh, const RaySpan& rays,
             std::span<std::uint8_t> hidden);
