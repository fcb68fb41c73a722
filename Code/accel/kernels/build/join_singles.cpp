#include "accel/kernels/build/write_tree.h"

#include <algorithm>
#include <utility>

using namespace kernels::build;

SinglesTree kernels::build::joinSingles(std::span<const BinaryNode> top,
                                        std::span<const SubtreeRange> subtrees,
                                        std::vector<Grown>& grown, ThreadPool& pool) {
    SinglesTree out;
    std::vector<std::uint32_t> first; // by grower
    std::uint32_t below = 0;
    for (const Grown& part : grown) {
        first.push_back(below);
        below += static_cast<std::uint32_t>(part.nodes.size());
    }
    const auto shifted = [](const BinaryNode& node, std::uint32_t by) {
        BinaryNode moved = node;
        if (!moved.isLeaf()) moved.left += by;
        return moved;
    };
    if (grown.size() == 1) out.nodes = std::move(grown[0].nodes);
    out.nodes.resize(below + top.size());
    if (grown.size() > 1)
        pool.run(grown.size(), [&](std::size_t i, int) {
            std::transform(grown[i].nodes.begin(), grown[i].nodes.end(),
                           out.nodes.begin() + static_cast<std::ptrdiff_t>(first[i]),
                           [&](const BinaryNode& node) { return shifted(node, first[i]); });
            grown[i] = {};
        });
    out.root = below;
    for (std::uint32_t i = 0; i < top.size(); ++i) {
        if (!top[i].isLeaf()) out.tops.push_back(below + i);
        out.nodes[below + i] = shifted(top[i], below);
    }
    for (const SubtreeRange& s : subtrees) {
        out.roots.push_back(below + s.range.node);
        out.nodes[out.roots.back()] = out.nodes[first[s.grower] + s.firstNode];
    }
    return out;
}
