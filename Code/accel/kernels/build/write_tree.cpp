#include "accel/kernels/build/write_tree.h"

#include "accel/kernels/build/collapse.h"
#include "accel/kernels/build/second_hand.h"
#include "accel/kernels/build/visit_order.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace kernels::build {

namespace {

template <int W> constexpr std::size_t kNodeLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);
template <int W> constexpr std::size_t kLeafLines = sizeof(WideLeaf<W>) / sizeof(WideTree::Line);

template <int W> class TreeWriter {
public:
    TreeWriter(WideTree& tree, std::span<const BinaryNode> top,
               std::span<const SubtreeRange> subtrees, std::vector<Grown>& grown,
               RawVector<PrimBox> scrap, ThreadPool& pool)
        : tree_(tree), binaryTop_(top), subtrees_(subtrees), grown_(grown),
          scrap_(std::move(scrap)), pool_(pool) {}

    void run() {
        place();
        pool_.run(subtrees_.size(), [&](std::size_t i, int) { take(i); });
        chooseTop();
        plan(top_, true);
        pool_.run(parts_.size(), [&](std::size_t i, int) { plan(parts_[i], false); });
        makeRoom();
        pool_.run(subtrees_.size(), [&](std::size_t i, int) { copyLeaves(i); });
        if (!tree_.isOfBoxes) {
            prospects_.resize(nodes_.size());
            pool_.run(parts_.size(), [&](std::size_t i, int) { sortForVisits(parts_[i]); });
            sortForVisits(top_);
        }
        write(top_);
        pool_.run(parts_.size(), [&](std::size_t i, int) { write(parts_[i]); });
        describe();
    }

private:
    using Choice = CollapseChoice<W>;

    // Half areas, added up.
    struct Areas {
        double leaves = 0, rest = 0; // rest: nodes, and leaves once for each triangle
        void add(const Areas& a) { leaves += a.leaves, rest += a.rest; }
    };
    // A wide node to be.
    struct Step {
        std::uint32_t binary, parent, depth; // parent: in the same part, or in the top
        WideChildren<W> children;
    };
    // Wide nodes that lie next to each other: those above the subtrees, then a part for each of
    // their children within one. What a part is does not depend on the threads that write it.
    struct Part {
        Step root{0, 0, 1, {}};
        std::vector<Step> steps{}; // depth first, children in the order of their areas
        std::uint32_t first = 0, depth = 0;
        Areas areas{};
    };

    // Where the nodes and leaves of each subtree come to lie.
    void place() {
        auto node = static_cast<std::uint32_t>(binaryTop_.size());
        std::uint32_t leaf = 0;
        isRoot_.resize(binaryTop_.size());
        for (const SubtreeRange& s : subtrees_) {
            isRoot_[s.range.node] = true;
            firstNode_.push_back(node), firstLeaf_.push_back(leaf);
            node += s.endNode - s.firstNode - 1; // its root is in the top already
            leaf += s.endLeaf - s.firstLeaf;
        }
        tree_.leaves = leaf;
        nodes_ = scrap_.take(node, freshNodes_);
        choices_ = scrap_.take(node, freshChoices_);
    }

    // Copies the nodes of a subtree to their places and chooses for all of them.
    void take(std::size_t i) {
        const SubtreeRange& s = subtrees_[i];
        const auto placeOf = [&](std::uint32_t n) { return n - s.firstNode - 1 + firstNode_[i]; };
        for (std::uint32_t end = s.endNode; end > s.firstNode; --end) {
            const std::uint32_t n = end - 1;
            BinaryNode node = grown_[s.grower].nodes[n];
            if (node.isLeaf())
                node.leaf = node.leaf - s.firstLeaf + firstLeaf_[i];
            else
                node.left = placeOf(node.left);
            const std::uint32_t at = n == s.firstNode ? s.range.node : placeOf(n);
            nodes_[at] = node;
            choose(at);
        }
    }

    void choose(std::uint32_t at) {
        const BinaryNode& node = nodes_[at];
        const float area = halfAreaOf(node);
        choices_[at] = node.isLeaf()
                           ? leafChoice<W>(area)
                           : innerChoice<W>(choices_[node.left], choices_[node.left + 1], area);
    }

    void chooseTop() {
        for (auto end = static_cast<std::uint32_t>(binaryTop_.size()); end > 0; --end) {
            const std::uint32_t at = end - 1;
            if (at == 1 || isRoot_[at]) continue; // 1: a gap
            nodes_[at] = binaryTop_[at];
            choose(at);
        }
    }

    bool isInSubtree(std::uint32_t at) const { return at >= binaryTop_.size() || isRoot_[at]; }

    void plan(Part& part, bool isTop) {
        std::vector<Step> open{part.root};
        while (!open.empty()) {
            Step step = open.back();
            open.pop_back();
            part.depth = std::max(part.depth, step.depth);
            step.children = childrenOf<W>(step.binary, std::span<const BinaryNode>(nodes_),
                                          std::span<const Choice>(choices_));
            const auto number = static_cast<std::uint32_t>(part.steps.size());
            for (std::size_t end = step.children.count; end > 0; --end) {
                const std::uint32_t child = step.children.node[end - 1];
                if (nodes_[child].isLeaf()) continue;
                const Step below{child, number, step.depth + 1, {}};
                if (isTop && isInSubtree(child))
                    parts_.push_back({below});
                else
                    open.push_back(below);
            }
            part.steps.push_back(step);
        }
    }

    // For the leaves, an empty one behind them for slots without a child, and the nodes.
    void makeRoom() {
        auto nodes = static_cast<std::uint32_t>(top_.steps.size());
        for (Part& part : parts_) {
            part.first = nodes;
            nodes += static_cast<std::uint32_t>(part.steps.size());
        }
        tree_.nodes = nodes;
        if (grown_.size() == 1) tree_.lines = std::move(grown_[0].lines); // in order already
        firstLine_ = tree_.isOfBoxes ? 0 : (tree_.leaves + 1) * kLeafLines<W>;
        const std::size_t lines = firstLine_ + nodes * kNodeLines<W>;
        tree_.lines.reserve(lines);
        tree_.lines.resize(lines);
        if (!tree_.isOfBoxes)
            std::memset(&tree_.lines[firstLine_ - kLeafLines<W>], 0, sizeof(WideLeaf<W>));
    }

    void copyLeaves(std::size_t i) {
        const SubtreeRange& s = subtrees_[i];
        if (grown_.size() == 1 || tree_.isOfBoxes || s.endLeaf == s.firstLeaf) return;
        std::memcpy(&tree_.lines[firstLeaf_[i] * kLeafLines<W>],
                    &grown_[s.grower].lines[s.firstLeaf * kLeafLines<W>],
                    (s.endLeaf - s.firstLeaf) * sizeof(WideLeaf<W>));
    }

    std::size_t lineOf(std::size_t node) const { return firstLine_ + node * kNodeLines<W>; }
    WideNode<W>& nodeAt(std::size_t number) {
        return *reinterpret_cast<WideNode<W>*>(&tree_.lines[lineOf(number)]);
    }
    WideRef leafRef(std::uint64_t leaf) const {
        return wideRef(tree_.isOfBoxes ? leaf : leaf * kLeafLines<W>, WideKind::Leaf);
    }

    // From the leaves up.
    void sortForVisits(Part& part) {
        const auto prospectOf = [&](std::uint32_t node) {
            const BinaryNode& n = nodes_[node];
            if (!n.isLeaf()) return prospects_[node];
            const std::uint8_t cover = tree_.at<WideLeaf<W>>(leafRef(n.leaf)).cover;
            return prospectOfLeaf(cover * kCoverUnit, halfAreaOf(n));
        };
        for (std::size_t end = part.steps.size(); end > 0; --end) {
            Step& step = part.steps[end - 1];
            prospects_[step.binary] = kernels::build::sortForVisits<W>(
                step.children, nodes_, halfAreaOf(nodes_[step.binary]), prospectOf);
        }
    }

    void write(Part& part) {
        for (std::size_t i = 0; i < part.steps.size(); ++i) {
            const Step& step = part.steps[i];
            const std::size_t at = part.first + i;
            part.areas.rest += static_cast<double>(halfAreaOf(nodes_[step.binary]));
            part.areas.add(write(nodeAt(at), step.children));
            if (at == 0) continue;
            const auto& siblings = (i > 0 ? part : top_).steps[step.parent].children.node;
            const auto slot = std::find(siblings.begin(), siblings.end(), step.binary);
            nodeAt(step.parent + (i > 0 ? part.first : 0))
                .child[static_cast<std::size_t>(slot - siblings.begin())] =
                wideRef(lineOf(at), WideKind::Node);
        }
    }

    // Returns the areas of the children that are leaves.
    Areas write(WideNode<W>& to, const WideChildren<W>& children) const {
        WideNode<W> node;
        std::memset(&node, 0, sizeof node); // behind the members, too: trees compare by bytes
        setChildren<W>(node, children, nodes_,
                       tree_.isOfBoxes ? wideRef(0, WideKind::None) : leafRef(tree_.leaves));
        Areas areas{};
        for (std::size_t i = 0; i < children.count; ++i) {
            const BinaryNode& child = nodes_[children.node[i]];
            if (!child.isLeaf()) continue;
            node.child[i] = leafRef(child.leaf);
            const auto area = static_cast<double>(halfAreaOf(child));
            areas.add(
                {area, tree_.isOfBoxes ? area : area * tree_.at<WideLeaf<W>>(node.child[i]).count});
        }
        std::memcpy(&to, &node, sizeof node);
        return areas;
    }

    void describe() {
        std::uint32_t depth = top_.depth;
        Areas areas = top_.areas;
        for (const Part& part : parts_) depth = std::max(depth, part.depth), areas.add(part.areas);
        tree_.root = wideRef(firstLine_, WideKind::Node);
        tree_.stackSize = depth * (W - 1) + 1;
        const double root = static_cast<double>(halfAreaOf(nodes_[0]));
        tree_.sah = root > 0 ? areas.rest / root : static_cast<double>(tree_.nodes);
        tree_.leavesPerRay = static_cast<float>(root > 0 ? areas.leaves / root : 0);
    }

    WideTree& tree_;
    std::span<const BinaryNode> binaryTop_;
    std::span<const SubtreeRange> subtrees_;
    std::vector<Grown>& grown_;
    SecondHand<PrimBox> scrap_;
    ThreadPool& pool_;
    std::vector<bool> isRoot_;                         // of a subtree; by node of the binary top
    std::vector<std::uint32_t> firstNode_, firstLeaf_; // of each subtree
    std::span<BinaryNode> nodes_;                      // children behind their parents
    std::span<Choice> choices_;
    RawVector<BinaryNode> freshNodes_;
    RawVector<Choice> freshChoices_;
    std::vector<Prospect> prospects_; // of the binary nodes that become wide ones
    Part top_;
    std::vector<Part> parts_;
    std::size_t firstLine_ = 0; // of the nodes
};

} // namespace

template <int W>
void writeTree(WideTree& tree, std::span<const BinaryNode> top,
               std::span<const SubtreeRange> subtrees, std::vector<Grown>& grown,
               RawVector<PrimBox> scrap, ThreadPool& pool) {
    TreeWriter<W>(tree, top, subtrees, grown, std::move(scrap), pool).run();
}
template void writeTree<8>(WideTree&, std::span<const BinaryNode>, std::span<const SubtreeRange>,
                           std::vector<Grown>&, RawVector<PrimBox>, ThreadPool&);
template void writeTree<16>(WideTree&, std::span<const BinaryNode>, std::span<const SubtreeRange>,
                            std::vector<Grown>&, RawVector<PrimBox>, ThreadPool&);

} // namespace kernels::build
