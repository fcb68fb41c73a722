#include "accel/kernels/build/write_tree.h"

#include "accel/kernels/build/collapse.h"

#include <algorithm>
#include <numeric>

namespace kernels::build {

namespace {

// Area is counted in that of the root: so many inner nodes does a ray through the root meet. The
// unit of time is a step of the search, which looks at one node: 17 to 19 ns. As wide nodes test 8
// or 16 children at once, and most rays end early, a tree with an area of 1 less saves 0.05 ns of a
// ray in a picture of 5000 boxes, 0.5 in one of 5000 wires in all directions, and nothing where the
// nodes that shrink are not those that become wide ones. The least counts: nobody should wait
// longer for a better tree than it is worth (tests/bench/trees.tsv).
constexpr double kStepsPerArea = 0.003;
// Before anything is known: the steps of a search, and the area that the first round saves. That is
// 0.02 for scanned meshes, up to 5 where large triangles and small ones mix.
constexpr double kUsualSteps = 30, kUsualSaving = 0.5;
// Parts of the nodes that are tried to be moved, the largest ones first: these gain most.
constexpr double kShares[] = {1.0 / 16, 1.0 / 4, 1};
// The first round with the next share takes up to so many times the steps.
constexpr double kMoreSteps = 8;
// Rounds with each share, and what one has to save for another to follow.
constexpr int kMostRounds = 8;
constexpr double kLeastSaving = 0.1;
// Where all boxes overlap, a search would see every node; others take 50 steps, at most 800.
constexpr std::uint64_t kMostSteps = 1000;
constexpr std::size_t kJobSize = 128;

// Bounds of two nodes: their areas are all that counts.
struct NodeBox {
    std::array<float, 3> lo, negHi;
    static NodeBox of(const BinaryNode& n) { return {n.lo, n.negHi}; }
    void extend(const BinaryNode& n) {
        for (std::size_t i = 0; i < 3; ++i) {
            lo[i] = std::min(lo[i], n.lo[i]);
            negHi[i] = std::min(negHi[i], n.negHi[i]);
        }
    }
    float halfArea() const {
        const float x = lo[0] + negHi[0], y = lo[1] + negHi[1], z = lo[2] + negHi[2];
        return x * y + y * z + z * x;
    }
};

std::uint32_t siblingOf(std::uint32_t node) { return node ^ 1; }

// Takes `from` out of its place, whose parent then has only its sibling and gives way to it, and
// makes it the sibling of `to`.
struct Move {
    float saved = 0; // area of inner nodes
    std::uint32_t from = 0, to = 0;
};

class Reinsertion {
public:
    Reinsertion(std::vector<BinaryNode>& nodes, ThreadPool& pool)
        : nodes_(nodes), pool_(pool), parents_(nodes.size()), isTaken_(nodes.size()) {
        for (std::uint32_t i = 0; i < nodes.size(); ++i)
            if (i != 1 && !nodes[i].isLeaf()) adopt(i);
    }

    struct Round {
        double steps = 0, saved = 0; // saved: area
        bool pays(double rays) const { return rays * kStepsPerArea * saved > steps; }
    };

    Round run(double share) {
        const double before = innerArea();
        const std::vector<std::uint32_t> from = largest(share);
        std::vector<Move> moves(from.size());
        std::vector<std::uint64_t> steps((from.size() + kJobSize - 1) / kJobSize);
        pool_.run(steps.size(), [&](std::size_t job, int) {
            std::vector<Open> open;
            const std::size_t end = std::min(from.size(), (job + 1) * kJobSize);
            for (std::size_t i = job * kJobSize; i < end; ++i)
                moves[i] = bestMove(from[i], open, steps[job]);
        });
        std::erase_if(moves, [](const Move& m) { return m.saved <= 0; });
        std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
            return a.saved != b.saved ? a.saved > b.saved : a.from < b.from;
        });
        std::fill(isTaken_.begin(), isTaken_.end(), false);
        for (const Move& m : moves)
            if (isPossible(m)) apply(m);
        Round round;
        for (const std::uint64_t s : steps) round.steps += static_cast<double>(s);
        round.saved = before - innerArea();
        return round;
    }

private:
    struct Open {
        float saved; // if the node goes below this one, but for what this one and it take together
        std::uint32_t node;
    };

    void adopt(std::uint32_t parent) {
        const std::uint32_t left = nodes_[parent].left;
        parents_[left] = parents_[left + 1] = parent;
    }

    double innerArea() const {
        const auto root = static_cast<double>(halfAreaOf(nodes_[0]));
        if (!(root > 0)) return 0;
        double sum = 0;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (i != 1 && !nodes_[i].isLeaf()) sum += static_cast<double>(halfAreaOf(nodes_[i]));
        return sum / root;
    }

    std::vector<std::uint32_t> largest(double share) const {
        std::vector<std::uint32_t> all(nodes_.size() - 2);
        std::iota(all.begin(), all.end(), 2u);
        const auto count = static_cast<std::size_t>(share * static_cast<double>(all.size()));
        std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                         [&](std::uint32_t a, std::uint32_t b) {
                             const float x = halfAreaOf(nodes_[a]), y = halfAreaOf(nodes_[b]);
                             return x != y ? x > y : a < b;
                         });
        all.resize(count);
        return all;
    }

    // Branch and bound (Meister and Bittner 2018): from the node upwards, and from every node on
    // the way down into the other side, as long as more could be saved there than so far.
    Move bestMove(std::uint32_t from, std::vector<Open>& open, std::uint64_t& steps) const {
        const BinaryNode& node = nodes_[from];
        const float area = halfAreaOf(node);
        const std::uint32_t parent = parents_[from];
        Move best{0, from, 0};
        float saved = halfAreaOf(nodes_[parent]);
        std::uint32_t side = siblingOf(from), above = parent;
        NodeBox without = NodeBox::of(nodes_[side]); // of `above`, when the node is gone
        const std::uint64_t last = steps + kMostSteps;
        for (;;) {
            open.push_back({saved, side});
            while (!open.empty()) {
                const Open o = open.back();
                open.pop_back();
                ++steps;
                if (o.saved - area <= best.saved || steps > last) continue;
                const BinaryNode& to = nodes_[o.node];
                NodeBox both = NodeBox::of(to);
                both.extend(node);
                const float here = o.saved - both.halfArea();
                if (here > best.saved) best.saved = here, best.to = o.node;
                if (to.isLeaf()) continue;
                const float below = here + halfAreaOf(to);
                if (below - area <= best.saved) continue;
                open.push_back({below, to.left});
                open.push_back({below, to.left + 1});
            }
            if (above == 0 || steps > last) break;
            if (above != parent) {
                without.extend(nodes_[side]);
                saved += halfAreaOf(nodes_[above]) - without.halfArea();
            }
            side = siblingOf(above), above = parents_[above];
        }
        // Where it is already.
        return best.to == siblingOf(from) || best.to == parent ? Move{} : best;
    }

    // Moves are found in the tree as it was before the first of them: no place may change twice.
    // None leads below itself, as a node goes below larger ones only; but for rounding.
    bool isPossible(const Move& m) {
        if (m.to == parents_[m.from]) return false;
        for (std::uint32_t at = m.to; at != 0; at = parents_[at])
            if (at == m.from) return false;
        const std::uint32_t nodes[] = {m.from, siblingOf(m.from), parents_[m.from], m.to,
                                       parents_[m.to]};
        for (const std::uint32_t n : nodes)
            if (isTaken_[n]) return false;
        for (const std::uint32_t n : nodes) isTaken_[n] = true;
        return true;
    }

    void apply(const Move& m) {
        const std::uint32_t sibling = siblingOf(m.from), parent = parents_[m.from];
        const BinaryNode stays = nodes_[sibling], meets = nodes_[m.to];
        nodes_[parent] = stays;
        nodes_[sibling] = meets;
        nodes_[m.to].left = std::min(m.from, sibling);
        for (const std::uint32_t moved : {parent, sibling})
            if (!nodes_[moved].isLeaf()) adopt(moved);
        adopt(m.to);
        fitFrom(m.to);
        fitFrom(parent);
    }

    void fitFrom(std::uint32_t at) {
        for (;; at = parents_[at]) {
            BinaryNode& node = nodes_[at];
            if (!node.isLeaf()) {
                NodeBox box = NodeBox::of(nodes_[node.left]);
                box.extend(nodes_[node.left + 1]);
                node.lo = box.lo, node.negHi = box.negHi;
            }
            if (at == 0) return;
        }
    }

    std::vector<BinaryNode>& nodes_;
    ThreadPool& pool_;
    std::vector<std::uint32_t> parents_;
    std::vector<bool> isTaken_;
};

// Children behind their parents again, depth first. False, and nothing done, if the tree is deeper
// than any may be.
bool putInOrder(std::span<const BinaryNode> from, std::span<BinaryNode> to) {
    struct Place {
        std::uint32_t from, to, left;
        std::size_t depth;
    };
    std::vector<Place> open{{0, 0, 0, 1}}, places;
    places.reserve(from.size());
    std::uint32_t next = 2;
    while (!open.empty()) {
        Place p = open.back();
        open.pop_back();
        if (p.depth > kMaxTreeDepth) return false;
        if (!from[p.from].isLeaf()) {
            p.left = next;
            const std::uint32_t left = from[p.from].left;
            open.push_back({left + 1, next + 1, 0, p.depth + 1});
            open.push_back({left, next, 0, p.depth + 1});
            next += 2;
        }
        places.push_back(p);
    }
    for (const Place& p : places) to[p.to] = from[p.from], to[p.to].left = p.left;
    return true;
}

} // namespace

bool reinsert(std::span<BinaryNode> nodes, double rays, ThreadPool& pool) {
    using Round = Reinsertion::Round;
    const double first = kShares[0] * static_cast<double>(nodes.size());
    if (first < 1 || !Round{first * kUsualSteps, kUsualSaving}.pays(rays)) return false;
    std::vector<BinaryNode> better(nodes.begin(), nodes.end());
    Reinsertion work(better, pool);
    bool moved = false;
    for (const double share : kShares) {
        Round round = work.run(share);
        moved = moved || round.saved > 0;
        Round next{kMoreSteps * round.steps, round.saved};
        for (int i = 1; i < kMostRounds && round.saved > kLeastSaving && round.pays(rays); ++i) {
            round = work.run(share);
            next.saved += round.saved;
        }
        if (!next.pays(rays)) break; // if it saves as much as all with this share
    }
    return moved && putInOrder(better, nodes);
}

} // namespace kernels::build
