// The last steps of the builder of trees: from the parts that its threads have made to one binary
// tree, a better one, and the wide tree.
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

// Makes a better binary tree, by moving subtrees to where they enlarge least area (Bittner et al.
// 2013): splits from the top down see centres only, and long or large triangles among small ones
// end up in boxes that every ray enters. All leaves stay as they are, so hits do too.
// Root at 0, a gap at 1, siblings at even numbers and the next; children behind their parents,
// before and after. Goes on as long as `rays` of them save more time than it takes; the same for
// any number of threads. False: nothing has moved.
bool reinsert(std::span<BinaryNode> nodes, double rays, ThreadPool& pool);

// From the binary tree of the builder to the wide one of the kernels.
// `top` is the binary tree down to the roots of the subtrees, which are in the order of the leaves.
// The boxes in `scrap` are not needed any more: their memory is used again. Many `rays` make a
// better tree (reinsert()). Of boxes (WideTree::isOfBoxes) there are no leaves to write.
template <int W>
void writeTree(WideTree& tree, std::span<const BinaryNode> top,
               std::span<const SubtreeRange> subtrees, std::vector<Grown>& grown,
               RawVector<PrimBox> scrap, double rays, ThreadPool& pool);

} // namespace kernels::build
