#include "accel/kernels/build/write_tree.h"

#include "accel/kernels/build/collapse.h"

#include <algorithm>
#include <cstring>

namespace kernels::build {

namespace {

template <int W> constexpr std::size_t kNodeLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);
template <int W> constexpr std::size_t kLeafLines = sizeof(WideLeaf<W>) / sizeof(WideTree::Line);

template <int W> class TreeWriter {
public:
    TreeWriter(WideTree& tree, std::vector<BinaryNode>& top, std::span<const SubtreeRange> subtrees,
               std::vector<Grown>& grown, ThreadPool& pool)
        : tree_(tree), top_(top), subtrees_(subtrees), grown_(grown), pool_(pool) {}

    void run() {
        place();
        pool_.run(subtrees_.size(), [&](std::size_t i, int) { take(i); });
        chooseTop();
        writeNodes();
    }

private:
    using Choice = CollapseChoice<W>;

    // Where the nodes and leaves of each subtree come to lie.
    void place() {
        auto node = static_cast<std::uint32_t>(top_.size());
        std::uint32_t leaf = 0;
        for (const SubtreeRange& s : subtrees_) {
            firstNode_.push_back(node), firstLeaf_.push_back(leaf);
            node += s.endNode - s.firstNode - 1; // its root is in the top already
            leaf += s.endLeaf - s.firstLeaf;
        }
        tree_.leaves = leaf;
        nodes_.resize(node), choices_.resize(node);
        const std::size_t lines = (leaf + std::size_t{1}) * kLeafLines<W>;
        if (grown_.size() == 1) tree_.lines = std::move(grown_[0].lines); // in order already
        tree_.lines.reserve(lines + (leaf / 6 + 16) * kNodeLines<W>);
        tree_.lines.resize(lines);
        // Behind the last leaf an empty one, for slots without a child.
        std::memset(&tree_.lines[lines - kLeafLines<W>], 0, sizeof(WideLeaf<W>));
    }

    // Copies a subtree to its place and chooses for all of its nodes.
    void take(std::size_t i) {
        const SubtreeRange& s = subtrees_[i];
        const Grown& from = grown_[s.grower];
        if (grown_.size() > 1 && s.endLeaf > s.firstLeaf)
            std::memcpy(&tree_.lines[firstLeaf_[i] * kLeafLines<W>],
                        &from.lines[s.firstLeaf * kLeafLines<W>],
                        (s.endLeaf - s.firstLeaf) * sizeof(WideLeaf<W>));
        const auto placeOf = [&](std::uint32_t n) { return n - s.firstNode - 1 + firstNode_[i]; };
        for (std::uint32_t end = s.endNode; end > s.firstNode; --end) {
            const std::uint32_t n = end - 1;
            BinaryNode node = from.nodes[n];
            if (node.isLeaf())
                node.leaf = node.leaf - s.firstLeaf + firstLeaf_[i];
            else
                node.left = placeOf(node.left);
            const std::uint32_t at = n == s.firstNode ? s.range.node : placeOf(n);
            nodes_[at] = node;
            choose(at);
        }
        top_[s.range.node] = nodes_[s.range.node];
    }

    void choose(std::uint32_t at) {
        const BinaryNode& node = nodes_[at];
        const float area = halfAreaOf(node);
        choices_[at] = node.isLeaf()
                           ? leafChoice<W>(area)
                           : innerChoice<W>(choices_[node.left], choices_[node.left + 1], area);
    }

    void chooseTop() {
        std::vector<bool> done(top_.size());
        for (const SubtreeRange& s : subtrees_) done[s.range.node] = true;
        done[1] = true; // a gap
        for (auto end = static_cast<std::uint32_t>(top_.size()); end > 0; --end) {
            const std::uint32_t at = end - 1;
            if (done[at]) continue;
            nodes_[at] = top_[at];
            choose(at);
        }
    }

    WideRef leafRef(std::uint32_t leaf) const {
        return wideRef(leaf * kLeafLines<W>, WideKind::Leaf);
    }

    // Depth first; a node's children in the order of their areas.
    void writeNodes() {
        struct Task {
            std::uint32_t binary, parent, slot, depth;
        };
        std::vector<Task> tasks{{0, 0, 0, 1}};
        const std::size_t firstLine = tree_.lines.size();
        std::uint32_t depth = 0;
        double area = 0;
        const auto nodeAt = [&](std::uint32_t number) -> WideNode<W>& {
            return *reinterpret_cast<WideNode<W>*>(
                &tree_.lines[firstLine + number * kNodeLines<W>]);
        };
        std::uint32_t count = 0;
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            depth = std::max(depth, task.depth);
            const std::uint32_t number = count++;
            tree_.lines.resize(tree_.lines.size() + kNodeLines<W>);
            if (number > 0)
                nodeAt(task.parent).child[task.slot] =
                    wideRef(firstLine + number * kNodeLines<W>, WideKind::Node);
            const auto children = childrenOf<W>(task.binary, nodes_, choices_);
            area += static_cast<double>(halfAreaOf(nodes_[task.binary])) +
                    write(nodeAt(number), children);
            for (std::size_t end = children.count; end > 0; --end) {
                const std::size_t i = end - 1;
                if (!nodes_[children.node[i]].isLeaf())
                    tasks.push_back(
                        {children.node[i], number, static_cast<std::uint32_t>(i), task.depth + 1});
            }
        }
        tree_.nodes = count;
        tree_.root = wideRef(firstLine, WideKind::Node);
        tree_.stackSize = depth * (W - 1) + 1;
        const double root = static_cast<double>(halfAreaOf(nodes_[0]));
        tree_.sah = root > 0 ? area / root : static_cast<double>(count);
    }

    // Returns the area of the triangles' leaves, once for each triangle.
    double write(WideNode<W>& to, const WideChildren<W>& children) const {
        WideNode<W> node;
        std::memset(&node, 0, sizeof node); // behind the members, too: trees compare by bytes
        for (auto& planes : node.plane) {
            std::fill_n(planes[0], W, std::numeric_limits<float>::infinity());
            std::fill_n(planes[1], W, -std::numeric_limits<float>::infinity());
        }
        std::fill_n(node.child, W, leafRef(static_cast<std::uint32_t>(tree_.leaves)));
        double area = 0;
        for (std::size_t i = 0; i < children.count; ++i) {
            const BinaryNode& child = nodes_[children.node[i]];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.plane[axis][0][i] = child.lo[axis];
                node.plane[axis][1][i] = -child.negHi[axis];
            }
            if (!child.isLeaf()) continue;
            node.child[i] = leafRef(child.leaf);
            area +=
                static_cast<double>(halfAreaOf(child)) * tree_.at<WideLeaf<W>>(node.child[i]).count;
        }
        std::memcpy(&to, &node, sizeof node);
        return area;
    }

    WideTree& tree_;
    std::vector<BinaryNode>& top_;
    std::span<const SubtreeRange> subtrees_;
    std::vector<Grown>& grown_;
    ThreadPool& pool_;
    std::vector<std::uint32_t> firstNode_, firstLeaf_; // of each subtree
    PageVector<BinaryNode> nodes_;                     // children behind their parents
    PageVector<Choice> choices_;
};

} // namespace

template <int W>
void writeTree(WideTree& tree, std::vector<BinaryNode>& top, std::span<const SubtreeRange> subtrees,
               std::vector<Grown>& grown, ThreadPool& pool) {
    TreeWriter<W>(tree, top, subtrees, grown, pool).run();
}
template void writeTree<8>(WideTree&, std::vector<BinaryNode>&, std::span<const SubtreeRange>,
                           std::vector<Grown>&, ThreadPool&);
template void writeTree<16>(WideTree&, std::vector<BinaryNode>&, std::span<const SubtreeRange>,
                            std::vector<Grown>&, ThreadPool&);

} // namespace kernels::build
