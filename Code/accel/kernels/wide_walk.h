// One ray through a wide tree in plain C++: for the questions that the kernels don't answer.
#pragma once

#include "accel/kernels/solids.h"
#include "accel/kernels/wide_tree.h"

// Does the ray enter this box, which a child of `node` has?
inline bool enters(const RaySetup& ray, WideRef, const Bounds& box, float zCut) {
    float z = 0;
    return ray.enters(box, zCut, z);
}

template <int W, class BoxRay, class LeafFn>
void traverseWidth(const WideTree& tree, const BoxRay& ray, float zCut, LeafFn& leaf) {
    std::vector<WideRef> stack{tree.root};
    while (!stack.empty()) {
        const WideRef ref = stack.back();
        stack.pop_back();
        if (kindOf(ref) == WideKind::Leaf) {
            const auto& l = tree.at<WideLeaf<W>>(ref);
            for (std::uint32_t i = 0; i < l.count; ++i)
                if (leaf(tree.triangleIds[l.first + i], zCut)) return;
            continue;
        }
        const auto& node = tree.at<WideNode<W>>(ref);
        for (std::size_t i = 0; i < W; ++i)
            if (enters(ray, ref, node.box(i), zCut)) stack.push_back(node.child[i]);
    }
}

// traverse() of bvh.h, in no order: leaf(triangle, zCut) may lower zCut; true stops. The ray is a
// RaySetup, or what else has an enters().
template <class BoxRay, class LeafFn>
void traverse(const WideTree& tree, const BoxRay& ray, float zCut, LeafFn&& leaf) {
    if (tree.width == 16)
        traverseWidth<16>(tree, ray, zCut, leaf);
    else
        traverseWidth<8>(tree, ray, zCut, leaf);
}

// One ray through the tree of solids in plain C++: for the questions that the kernels don't answer.

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
