#include "accel/kernels/build/collapse.h"

#include <algorithm>

namespace kernels::build {

template <int W> CollapseChoice<W> leafChoice(float area) {
    CollapseChoice<W> c;
    c.cost[0] = area, c.left[0] = 0;
    c.split = 0, c.places = 1;
    return c;
}

template <int W>
CollapseChoice<W> innerChoice(const CollapseChoice<W>& a, const CollapseChoice<W>& b, float area) {
    CollapseChoice<W> c;
    const std::size_t most = std::min<std::size_t>(W, std::size_t{a.places} + b.places);
    std::fill_n(c.cost.begin(), most, std::numeric_limits<float>::max());
    std::fill_n(c.left.begin(), most, std::uint8_t{0});
    for (std::size_t k = 1; k <= a.places && k < most; ++k)          // from the left
        for (std::size_t m = 1; m <= b.places && k + m <= most; ++m) // from the right
            if (const float cost = a.cost[k - 1] + b.cost[m - 1]; cost < c.cost[k + m - 1])
                c.cost[k + m - 1] = cost, c.left[k + m - 1] = static_cast<std::uint8_t>(k);
    c.places = static_cast<std::uint8_t>(most);
    c.split = c.left[most - 1];
    c.cost[0] = c.cost[most - 1] + area;
    for (std::size_t k = 1; k < most; ++k)
        if (c.cost[k - 1] <= c.cost[k]) c.cost[k] = c.cost[k - 1], c.left[k] = c.left[k - 1];
    return c;
}

template <int W, class Plan>
WideChildren<W> childrenOf(std::uint32_t at, std::span<const BinaryNode> nodes,
                           std::span<const Plan> plans) {
    WideChildren<W> out;
    if (nodes[at].isLeaf()) { // a tree of one leaf
        out.node[0] = at, out.count = 1;
        return out;
    }
    struct Open {
        std::uint32_t node;
        int slots;
    };
    std::array<Open, W + 1> open; // each has a slot of its own
    std::size_t size = 0;
    const auto openBoth = [&](std::uint32_t node, int left, int slots) {
        open[size++] = {nodes[node].left + 1, slots - left};
        open[size++] = {nodes[node].left, left};
    };
    openBoth(at, plans[at].split, W);
    while (size > 0) {
        const Open o = open[--size];
        const int left = plans[o.node].leftOf(o.slots);
        if (o.slots > 1 && left > 0) {
            openBoth(o.node, left, o.slots);
            continue;
        }
        // Sorted in behind those of its area.
        std::size_t i = out.count++;
        const float area = halfAreaOf(nodes[o.node]);
        for (; i > 0 && halfAreaOf(nodes[out.node[i - 1]]) < area; --i)
            out.node[i] = out.node[i - 1];
        out.node[i] = o.node;
    }
    return out;
}

template CollapseChoice<8> leafChoice<8>(float);
template CollapseChoice<16> leafChoice<16>(float);
template CollapseChoice<8> innerChoice<8>(const CollapseChoice<8>&, const CollapseChoice<8>&,
                                          float);
template CollapseChoice<16> innerChoice<16>(const CollapseChoice<16>&, const CollapseChoice<16>&,
                                            float);
template WideChildren<8> childrenOf<8>(std::uint32_t, std::span<const BinaryNode>,
                                       std::span<const CollapseChoice<8>>);
template WideChildren<8> childrenOf<8>(std::uint32_t, std::span<const BinaryNode>,
                                       std::span<const CollapsePlan<8>>);
template WideChildren<16> childrenOf<16>(std::uint32_t, std::span<const BinaryNode>,
                                         std::span<const CollapseChoice<16>>);
template WideChildren<16> childrenOf<16>(std::uint32_t, std::span<const BinaryNode>,
                                         std::span<const CollapsePlan<16>>);

} // namespace kernels::build
