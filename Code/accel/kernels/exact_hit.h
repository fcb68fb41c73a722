// The canonical hit for the few candidates that a kernel's vectors can't decide, out of line and in
// plain code, so that there is one machine code of it.
#pragma once

#include "accel/kernels/kernels.h"

#include <memory>

// canonicalKey() of a leaf's triangle, from the leaf's own copy of the points: it is in the cache.
template <int W>
float exactKey(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lane);

// Memory of a thread for one call, kept for the next. 64-byte aligned, not cleared.
std::byte* scratchMemory(std::size_t bytes);
