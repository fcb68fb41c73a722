// One ray through a wide tree in plain C++: for the questions that the kernels don't answer.
#pragma once

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
