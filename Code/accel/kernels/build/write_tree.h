// The last step of the builder of trees: from the parts that its threads have made to one binary
// tree, and to the wide one.
#pragma once

#include "accel/kernels/build/build.h"
#include "base/parallel.h"

#include <span>
#include <vector>

namespace kernels::build {

// What has become of a range: nodes and leaves of its grower, the first node is its root.
struct SubtreeRange {
    BuildRange range; // its node: among those of the top
    std::uint32_t grower = 0;
    std::uint32_t firstNode = 0, endNode = 0, firstLeaf = 0, endLeaf = 0;
};

// From the binary tree of the builder to the wide one of the kernels.
// `top` is the binary tree down to the roots of the subtrees, which are in the order of the leaves.
// The boxes in `scrap` are not needed any more: their memory is used again. Of boxes
// (WideTree::isOfBoxes) there are no leaves to write. (Subtrees moved to where they enlarge least
// area, Bittner et al. 2013, gave pictures with 16 samples per pixel 0.97 to 1.03 of the time.)
template <int W>
void writeTree(WideTree& tree, std::span<const BinaryNode> top,
               std::span<const SubtreeRange> subtrees, std::vector<Grown>& grown,
               RawVector<PrimBox> scrap, ThreadPool& pool);

} // namespace kernels::build
