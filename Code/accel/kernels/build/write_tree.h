// From the binary tree of the builder to the wide one of the kernels.
#pragma once

#include "accel/kernels/build/build.h"
#include "base/parallel.h"

namespace kernels::build {

// What has become of a range: nodes and leaves of its grower, the first node is its root.
struct SubtreeRange {
    BuildRange range; // its node: among those of the top
    std::uint32_t grower = 0;
    std::uint32_t firstNode = 0, endNode = 0, firstLeaf = 0, endLeaf = 0;
};

// `top` is the binary tree down to the roots of the subtrees, which are in the order of the leaves.
// The boxes in `scrap` are not needed any more: their memory is used again. Many `rays` make a
// better tree (reinsert.h).
template <int W>
void writeTree(WideTree& tree, std::span<const BinaryNode> top,
               std::span<const SubtreeRange> subtrees, std::vector<Grown>& grown,
               RawVector<PrimBox> scrap, double rays, ThreadPool& pool);

} // namespace kernels::build
