// The wide tree over solids: the binary one down to single solids, collapsed with the least area.
// (Moving parts of it before, as meshes do, takes more time than 10^6 rays win by it.)
#include "accel/kernels/build/collapse.h"
#include "accel/kernels/solids.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace {

using namespace kernels::build;

BinaryNode nodeOf(const Bounds& box) {
    return {{box.lo.x, box.lo.y, box.lo.z}, 0, {-box.hi.x, -box.hi.y, -box.hi.z}, 0};
}

// A tree with a leaf for every solid: where the other one has lists, these are halved.
class Singles {
public:
    Singles(const Bvh& bvh, std::span<const Bounds> boxes) : bvh_(bvh), boxes_(boxes) {
        nodes_.reserve(2 * boxes.size());
        nodes_.push_back(nodeOf(bvh.nodes[0].box));
        struct Open {
            std::uint32_t from, to;
        };
        std::vector<Open> open{{0, 0}};
        while (!open.empty()) {
            const auto [from, to] = open.back();
            open.pop_back();
            const BvhNode& node = bvh_.nodes[from];
            if (node.isLeaf()) {
                halve(to, std::span(bvh_.primIds).subspan(node.first, node.count));
                continue;
            }
            const std::uint32_t child =
                addChildren(to, bvh_.nodes[node.first].box, bvh_.nodes[node.first + 1].box);
            open.push_back({node.first + 1, child + 1});
            open.push_back({node.first, child});
        }
    }
    std::vector<BinaryNode> take() { return std::move(nodes_); } // children behind their parents

private:
    std::uint32_t addChildren(std::uint32_t at, const Bounds& left, const Bounds& right) {
        const auto child = static_cast<std::uint32_t>(nodes_.size());
        nodes_[at].left = child;
        nodes_.push_back(nodeOf(left));
        nodes_.push_back(nodeOf(right));
        return child;
    }
    Bounds boxOf(std::span<const std::uint32_t> solids) const {
        Bounds box;
        for (const std::uint32_t id : solids) box.extend(boxes_[id]);
        return box;
    }
    void halve(std::uint32_t at, std::span<const std::uint32_t> solids) {
        if (solids.size() == 1) {
            nodes_[at].leaf = solids[0];
            return;
        }
        const auto left = solids.first(solids.size() / 2), right = solids.subspan(left.size());
        const std::uint32_t child = addChildren(at, boxOf(left), boxOf(right));
        halve(child, left);
        halve(child + 1, right);
    }

    const Bvh& bvh_;
    std::span<const Bounds> boxes_;
    std::vector<BinaryNode> nodes_;
};

// Puts W children below every node.
template <int W> class TreeWriter {
public:
    TreeWriter(SolidTree& tree, std::span<const BinaryNode> nodes)
        : tree_(tree), nodes_(nodes), choices_(nodes.size()), solids_(std::move(tree.solids)),
          boxes_(std::move(tree.boxes)) {}

    void run() {
        for (std::size_t end = nodes_.size(); end > 0; --end) {
            const std::size_t at = end - 1;
            const BinaryNode& node = nodes_[at];
            const float area = halfAreaOf(node);
            choices_[at] = node.isLeaf()
                               ? leafChoice<W>(area)
                               : innerChoice<W>(choices_[node.left], choices_[node.left + 1], area);
        }
        tree_.solids.clear(), tree_.boxes.clear();
        tree_.solids.reserve(solids_.size()), tree_.boxes.reserve(boxes_.size());
        write(0);
    }

private:
    WideRef write(std::uint32_t at) {
        const WideChildren<W> children =
            childrenOf<W>(at, nodes_, std::span<const CollapseChoice<W>>(choices_));
        constexpr std::size_t kLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);
        const std::size_t line = tree_.lines.size();
        tree_.lines.resize(line + kLines);
        WideNode<W> node;
        for (auto& planes : node.plane) {
            std::fill_n(planes[0], W, kInfinityF);
            std::fill_n(planes[1], W, -kInfinityF);
        }
        std::fill_n(node.child, W, wideRef(0, WideKind::None));
        for (std::size_t i = 0; i < children.count; ++i) {
            const BinaryNode& child = nodes_[children.node[i]];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.plane[axis][0][i] = child.lo[axis];
                node.plane[axis][1][i] = -child.negHi[axis];
            }
            if (child.isLeaf()) node.child[i] = addSolid(child.leaf);
        }
        // After all solids of the node, which so lie in a row.
        for (std::size_t i = 0; i < children.count; ++i)
            if (!nodes_[children.node[i]].isLeaf()) node.child[i] = write(children.node[i]);
        std::memcpy(&tree_.lines[line], &node, sizeof node);
        return wideRef(line, WideKind::Node);
    }
    WideRef addSolid(std::uint32_t index) {
        tree_.solids.push_back(solids_[index]);
        tree_.boxes.push_back(boxes_[index]);
        return wideRef(tree_.solids.size() - 1, WideKind::Leaf);
    }

    SolidTree& tree_;
    std::span<const BinaryNode> nodes_;
    std::vector<CollapseChoice<W>> choices_;
    const std::vector<SolidTree::Solid> solids_;
    const std::vector<Bounds> boxes_;
};

} // namespace

void SolidTree::build(int nodeWidth, const Bvh& bvh) {
    width = nodeWidth;
    lines.clear();
    if (bvh.nodes.empty()) return;
    const std::vector<BinaryNode> nodes = Singles(bvh, boxes).take();
    if (nodeWidth == 16)
        TreeWriter<16>(*this, nodes).run();
    else
        TreeWriter<8>(*this, nodes).run();
}
