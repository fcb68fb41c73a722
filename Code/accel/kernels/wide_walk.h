// One ray through a wide tree in plain C++, the nearest children first: the search of the one-lane
// code, and what answers the questions that the kernels don't.
#pragma once

#include "accel/four.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/wide_tree.h"

#include <array>
#include <utility>

namespace wide_walk {

struct Entry {
    float z;
    WideRef ref;
};

// RaySetup::enters() of all children of a node, with so much room before the start of the ray and
// behind the cut. Those that it enters go to the stack, the nearest one last. Returns its new size.
template <int W>
std::size_t enterChildren(const WideNode<W>& node, const RaySetup& ray, float room, float zCut,
                          Entry* stack, std::size_t size) {
    const std::size_t others = size;
    for (std::size_t first = 0; first < W; first += 4) {
        Four entry = allFour(-room), exit = allFour(zCut + room);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool backwards = ray.r[axis] < 0;
            const float* const nearPlanes = node.plane[axis][backwards ? 1 : 0];
            const float* const farPlanes = node.plane[axis][backwards ? 0 : 1];
            entry = most(loadFour(nearPlanes + first) * ray.r[axis] + ray.nearOffset[axis], entry);
            exit = least(loadFour(farPlanes + first) * ray.r[axis] + ray.farOffset[axis], exit);
        }
        alignas(16) std::array<std::int32_t, 4> isEntered;
        alignas(16) std::array<float, 4> z;
        storeFour(entry <= exit, isEntered.data()), storeFour(entry - room, z.data());
        for (std::size_t i = 0; i < 4; ++i) {
            if (isEntered[i] == 0) continue;
            std::size_t at = size++;
            for (; at > others && stack[at - 1].z < z[i]; --at) stack[at] = stack[at - 1];
            stack[at] = {z[i], node.child[first + i]};
        }
    }
    return size;
}

// nodeAt(ref): a WideNode<W>; roomAt(ref): the room at its children; leaf(ref, zCut) may lower
// zCut, and true stops, which is returned.
template <int W, class NodeFn, class RoomFn, class LeafFn>
bool walk(WideRef root, const RaySetup& ray, float& zCut, NodeFn&& nodeAt, RoomFn&& roomAt,
          LeafFn&& leaf) {
    std::array<Entry, kMaxTreeDepth*(W - 1) + 1> stack;
    std::size_t size = 0;
    for (WideRef at = root;;) {
        if (kindOf(at) == WideKind::Node)
            size = enterChildren<W>(nodeAt(at), ray, roomAt(at), zCut, stack.data(), size);
        else if (leaf(at, zCut))
            return true;
        // Strictly behind the best hit: an equally near one with a lower number must still be seen.
        do {
            if (size == 0) return false;
            --size;
        } while (stack[size].z > zCut);
        at = stack[size].ref;
    }
}

} // namespace wide_walk

// leaf(triangle, zCut) for the triangles of leaves that the ray enters in front of zCut, which leaf
// may lower; true stops. roomAt(line): see wide_walk::enterChildren(), by the line of a node.
template <class RoomFn, class LeafFn>
void traverse(const WideTree& tree, const RaySetup& ray, float zCut, RoomFn&& roomAt,
              LeafFn&& leaf) {
    const auto walk = [&]<int W>(std::integral_constant<int, W>) {
        wide_walk::walk<W>(
            tree.root, ray, zCut,
            [&](WideRef ref) -> const WideNode<W>& { return tree.at<WideNode<W>>(ref); },
            [&](WideRef ref) { return roomAt(ref >> 2); },
            [&](WideRef ref, float& cut) {
                const auto& l = tree.at<WideLeaf<W>>(ref);
                for (std::uint32_t i = 0; i < l.count; ++i)
                    if (leaf(tree.triangleIds[l.first + i], cut)) return true;
                return false;
            });
    };
    tree.width == 16 ? walk(std::integral_constant<int, 16>())
                     : walk(std::integral_constant<int, 8>());
}

// leaf(number of the solid, zCut) likewise; true stops, and is returned.
template <class LeafFn>
bool traverse(const SolidTree& tree, const RaySetup& ray, float& zCut, LeafFn&& leaf) {
    if (tree.lines.empty()) return false;
    const auto walk = [&]<int W>(std::integral_constant<int, W>) {
        return wide_walk::walk<W>(
            wideRef(0, WideKind::Node), ray, zCut,
            [&](WideRef ref) -> const WideNode<W>& { return tree.node<W>(ref); },
            [](WideRef) { return 0.0f; },
            [&](WideRef ref, float& cut) { return leaf(tree.solids[ref >> 2].number, cut); });
    };
    return tree.width == 16 ? walk(std::integral_constant<int, 16>())
                            : walk(std::integral_constant<int, 8>());
}
