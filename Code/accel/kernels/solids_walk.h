// One ray through the tree of solids in plain C++: for the questions that the kernels don't answer.
#pragma once

#include "accel/kernels/solids.h"

namespace solids_walk {

template <int W, class LeafFn>
bool walk(const SolidTree& tree, WideRef ref, const RaySetup& ray, float& zCut, LeafFn& leaf) {
    struct Entry {
        float z;
        WideRef child;
    };
    std::array<Entry, W> entered; // the nearest first
    std::size_t count = 0;
    const WideNode<W>& node = tree.node<W>(ref);
    for (std::size_t i = 0; i < W && kindOf(node.child[i]) != WideKind::None; ++i) {
        float z = 0;
        if (!ray.enters(node.box(i), zCut, z)) continue;
        std::size_t at = count++;
        for (; at > 0 && entered[at - 1].z > z; --at) entered[at] = entered[at - 1];
        entered[at] = {z, node.child[i]};
    }
    for (std::size_t i = 0; i < count && !(entered[i].z > zCut); ++i) {
        const WideRef child = entered[i].child;
        if (SolidTree::isLeaf(child) ? leaf(tree.solids[child >> 2].number, zCut)
                                     : walk<W>(tree, child, ray, zCut, leaf))
            return true;
    }
    return false;
}

} // namespace solids_walk

// traverse() of bvh.h: leaf(number of the solid, zCut) may lower zCut; true stops, and is returned.
template <class LeafFn>
bool traverse(const SolidTree& tree, const RaySetup& ray, float& zCut, LeafFn&& leaf) {
    constexpr WideRef kRoot = wideRef(0, WideKind::Node);
    if (tree.lines.empty()) return false;
    return tree.width == 16 ? solids_walk::walk<16>(tree, kRoot, ray, zCut, leaf)
                            : solids_walk::walk<8>(tree, kRoot, ray, zCut, leaf);
}
