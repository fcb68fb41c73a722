// The canonical hit for the few candidates that a kernel's filter leaves, out of line and in plain
// code, so that there is one machine code of it.
#pragma once

#include "accel/kernels/kernels.h"

#include <memory>

// The best hit of one ray so far. below: keys that count are smaller, as t > tMin.
struct RayBest {
    float key, below;
    std::uint32_t triangle;
    std::uint32_t lane = 0; // of its leaf
};

// canonicalKey() of a leaf's triangle, from the leaf's own copy of the points: it is in the cache.
template <int W>
float exactKey(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lane);

// Tests the triangles of `lanes`; true when one is better than the best so far.
template <int W>
bool improve(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lanes,
             RayBest& best);
// Is one of them a hit in front of best.key?
template <int W>
bool hits(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lanes,
          const RayBest& best);

// For AVX2: which lanes a mask chooses, in order.
extern const std::array<std::array<std::uint8_t, 8>, 256> kChosenLanes;

// Memory of a thread for one call, kept for the next. 64-byte aligned, not cleared.
std::byte* scratchMemory(std::size_t bytes);
