// A better binary tree, by moving subtrees to where they enlarge least area (Bittner et al. 2013):
// splits from the top down see centres only, and long or large triangles among small ones end up in
// boxes that every ray enters. All leaves stay as they are, so hits do too.
#pragma once

#include "accel/kernels/build/build.h"
#include "base/parallel.h"

namespace kernels::build {

// Root at 0, a gap at 1, siblings at even numbers and the next; children behind their parents,
// before and after. Goes on as long as `rays` of them save more time than it takes; the same for
// any number of threads. False: nothing has moved.
bool reinsert(std::span<BinaryNode> nodes, double rays, ThreadPool& pool);

} // namespace kernels::build
