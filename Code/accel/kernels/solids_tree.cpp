// The wide tree over solids: a binary one down to single solids by the steps of the meshes'
// builder, collapsed with the least area. (Moving parts of it before, as meshes do, takes more time
// than 10^6 rays win by it.) Subtrees are one thread's work; where they are cut depends on the
// solids alone.
#include "accel/kernels/build/collapse.h"
#include "accel/kernels/solids.h"
#include "base/for_each.h"
#include "base/raw_vector.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

namespace {

using namespace kernels::build;

// Puts W children below every node.
template <int W> class SolidTreeWriter {
public:
    SolidTreeWriter(SinglesTree singles, int threads)
        : nodes_(std::move(singles.nodes)), root_(singles.root), roots_(std::move(singles.roots)),
          tops_(std::move(singles.tops)), threads_(threads), plans_(nodes_.size()) {}

    std::vector<std::uint32_t> run(SolidTree& tree) {
        planAll();
        Piece top;
        if (tops_.empty())
            pieces_.push_back({root_, {}, {}, 0});
        else
            write(top, root_, true);
        forEachOn(threads_, pieces_.size(),
                  [&](std::size_t i) { write(pieces_[i], pieces_[i].root, false); });
        return join(tree, top);
    }

private:
    static constexpr std::size_t kLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);

    // Wide nodes that lie in a row, and the solids in their leaves; references count from there.
    struct Piece {
        std::uint32_t root = 0;
        RawVector<WideTree::Line> lines{};
        std::vector<std::uint32_t> order{};
        double area = 0; // of nodes and leaves
    };
    // A child in the top that is the root of a piece.
    struct Link {
        std::size_t line, slot;
    };

    // What is chosen stays; costs are asked for by the parent alone.
    CollapseChoice<W> keep(std::uint32_t at, const CollapseChoice<W>& choice) {
        plans_[at] = choice;
        return choice;
    }
    CollapseChoice<W> plan(std::uint32_t at) {
        const BinaryNode& node = nodes_[at];
        const float area = halfAreaOf(node);
        if (node.isLeaf()) return keep(at, leafChoice<W>(area));
        const CollapseChoice<W> left = plan(node.left), right = plan(node.left + 1);
        return keep(at, innerChoice<W>(left, right, area));
    }
    void planAll() {
        std::vector<CollapseChoice<W>> ofRoots(roots_.size());
        forEachOn(threads_, roots_.size(), [&](std::size_t i) { ofRoots[i] = plan(roots_[i]); });
        std::map<std::uint32_t, CollapseChoice<W>> known;
        for (std::size_t i = 0; i < roots_.size(); ++i) known[roots_[i]] = ofRoots[i];
        for (std::size_t end = tops_.size(); end > 0; --end) { // children before parents
            const std::uint32_t at = tops_[end - 1], left = nodes_[at].left;
            known[at] = keep(
                at, innerChoice<W>(known.at(left), known.at(left + 1), halfAreaOf(nodes_[at])));
        }
    }

    bool isTop(std::uint32_t at) const {
        return std::binary_search(tops_.begin(), tops_.end(), at);
    }

    WideRef write(Piece& piece, std::uint32_t at, bool inTop) {
        const WideChildren<W> children = childrenOf<W>(at, std::span<const BinaryNode>(nodes_),
                                                       std::span<const CollapsePlan<W>>(plans_));
        const std::size_t line = piece.lines.size();
        piece.lines.resize(line + kLines);
        piece.area += static_cast<double>(halfAreaOf(nodes_[at]));
        WideNode<W> node;
        setChildren<W>(node, children, nodes_, wideRef(0, WideKind::None));
        for (std::size_t i = 0; i < children.count; ++i) {
            const BinaryNode& child = nodes_[children.node[i]];
            if (!child.isLeaf()) continue;
            piece.area += static_cast<double>(halfAreaOf(child));
            node.child[i] = wideRef(piece.order.size(), WideKind::Leaf);
            piece.order.push_back(child.leaf);
        }
        // After all solids of the node, which so lie in a row.
        for (std::size_t i = 0; i < children.count; ++i) {
            const std::uint32_t child = children.node[i];
            if (nodes_[child].isLeaf()) continue;
            if (inTop && !isTop(child)) {
                pieces_.push_back({child, {}, {}, 0});
                links_.push_back({line, i});
            } else
                node.child[i] = write(piece, child, inTop);
        }
        std::memcpy(&piece.lines[line], &node, sizeof node);
        return wideRef(line, WideKind::Node);
    }

    // The top, and the pieces behind it.
    std::vector<std::uint32_t> join(SolidTree& tree, Piece& top) {
        std::vector<std::size_t> firstLine, firstSolid;
        const auto root = static_cast<double>(halfAreaOf(nodes_[root_]));
        const auto& [lo, negHi] = std::pair(nodes_[root_].lo, nodes_[root_].negHi);
        tree.around = {{lo[0], lo[1], lo[2]}, {-negHi[0], -negHi[1], -negHi[2]}};
        RawVector<BinaryNode>().swap(nodes_); // for the tree to take their place
        RawVector<CollapsePlan<W>>().swap(plans_);
        std::size_t lines = top.lines.size(), solids = top.order.size();
        double area = top.area;
        for (const Piece& piece : pieces_) {
            firstLine.push_back(lines), firstSolid.push_back(solids);
            lines += piece.lines.size(), solids += piece.order.size();
            area += piece.area;
        }
        for (std::size_t i = 0; i < links_.size(); ++i) {
            const Link& link = links_[i];
            reinterpret_cast<WideNode<W>*>(&top.lines[link.line])->child[link.slot] =
                wideRef(firstLine[i], WideKind::Node);
        }
        tree.lines.resize(lines);
        std::copy(top.lines.begin(), top.lines.end(), tree.lines.begin());
        std::vector<std::uint32_t> order(solids);
        std::copy(top.order.begin(), top.order.end(), order.begin());
        forEachOn(threads_, pieces_.size(), [&](std::size_t i) {
            Piece& piece = pieces_[i];
            WideTree::Line* to = &tree.lines[firstLine[i]];
            for (std::size_t line = 0; line < piece.lines.size(); line += kLines, to += kLines) {
                WideNode<W> node;
                std::memcpy(&node, &piece.lines[line], sizeof node);
                for (WideRef& child : node.child) {
                    const bool isNode = kindOf(child) == WideKind::Node;
                    if (isNode || kindOf(child) == WideKind::Leaf)
                        child += wideRef(isNode ? firstLine[i] : firstSolid[i], WideKind::Node);
                }
                std::memcpy(to, &node, sizeof node);
            }
            std::copy(piece.order.begin(), piece.order.end(),
                      order.begin() + static_cast<std::ptrdiff_t>(firstSolid[i]));
            piece = {};
        });
        tree.sah = root > 0 ? area / root : static_cast<double>(tree.nodes() + solids);
        return order;
    }

    RawVector<BinaryNode> nodes_;
    std::uint32_t root_;
    std::vector<std::uint32_t> roots_, tops_;
    int threads_;
    RawVector<CollapsePlan<W>> plans_;  // by node
    std::vector<Piece> pieces_;         // in the order of the links to them
    std::vector<Link> links_;
};

} // namespace

std::vector<std::uint32_t> SolidTree::writeNodes(std::span<const Bounds> of, int threads) {
    lines.clear();
    if (of.empty()) return {};
    SinglesTree singles = growSinglesBy(*bestIsa().build, of, threads);
    return width == 16 ? SolidTreeWriter<16>(std::move(singles), threads).run(*this)
                       : SolidTreeWriter<8>(std::move(singles), threads).run(*this);
}
