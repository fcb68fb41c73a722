// Which nodes of a binary tree become the children of a wide one: the choice of least area by a
// dynamic program from the leaves up (Ylitie et al. 2017).
#pragma once

#include "accel/kernels/build/build.h"

#include <algorithm>

namespace kernels::build {

// Sums of areas are finite, also of what is far away (ShapeSet::distant).
inline float halfAreaOf(const BinaryNode& node) {
    constexpr float kMost = 1e28f;
    const float x = node.lo[0] + node.negHi[0], y = node.lo[1] + node.negHi[1];
    const float z = node.lo[2] + node.negHi[2]; // both signs of a size do
    const float area = x * y + y * z + z * x;
    return area < kMost ? area : kMost;
}

// Of a subtree that takes at most k places among the children of a wide node. left[k - 1]: how many
// of these its left child gets, 0: it takes one itself.
template <int W> struct CollapsePlan {
    std::array<std::uint8_t, W> left;
    std::uint8_t split;  // the same for its own wide node
    std::uint8_t places; // more than these it can't fill; at most W
    std::uint8_t leftOf(int slots) const {
        return left[static_cast<std::size_t>(std::min(slots, int{places})) - 1];
    }
};
// With what its parent chooses by: cost[k - 1], the area of the wide nodes below it.
template <int W> struct CollapseChoice : CollapsePlan<W> { std::array<float, W> cost; };

// From the choices of the two children to that of their parent, or that of a leaf.
template <int W> CollapseChoice<W> leafChoice(float area);
template <int W>
CollapseChoice<W> innerChoice(const CollapseChoice<W>& a, const CollapseChoice<W>& b, float area);

// The children of a wide node, the one of the largest area first.
template <int W> struct WideChildren {
    std::array<std::uint32_t, W> node;
    std::size_t count = 0;
};
template <int W, class Plan> // CollapsePlan<W>, or what is one
WideChildren<W> childrenOf(std::uint32_t at, std::span<const BinaryNode> nodes,
                           std::span<const Plan> plans);

// The boxes of the children in a wide node. Slots without a child have one that no ray enters, and
// refer to `none`; to what the others refer is the caller's.
template <int W>
void setChildren(WideNode<W>& node, const WideChildren<W>& children,
                 std::span<const BinaryNode> nodes, WideRef none) {
    for (auto& planes : node.plane) {
        std::fill_n(planes[0], W, std::numeric_limits<float>::infinity());
        std::fill_n(planes[1], W, -std::numeric_limits<float>::infinity());
    }
    std::fill_n(node.child, W, none);
    for (std::size_t i = 0; i < children.count; ++i) {
        const BinaryNode& child = nodes[children.node[i]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.plane[axis][0][i] = child.lo[axis];
            node.plane[axis][1][i] = -child.negHi[axis];
        }
    }
}

} // namespace kernels::build
