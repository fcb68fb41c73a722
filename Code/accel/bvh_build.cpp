// The plain builder: the same way as that of the kernels (kernels/wide_build.cpp), for boxes of
// anything and in C++ alone. A pass over a range sorts its primitives into two halves and into the
// bins of both (bvh_divide.h); the ranges of the top are divided level by level, each by all
// threads or, where there are enough of them, by one, what is below are subtrees, one thread each.
#include "accel/bvh.h"
#include "accel/bvh_divide.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace {

using namespace bvh_build;

// A tree over more primitives than these must cost less than this part of what their plain list
// does: a list is read in the order of memory, which is up to ten times as fast.
constexpr std::uint32_t kMany = 1000;
constexpr double kWorthwhile = 0.8;
// From this depth on every split halves the list, which ends after at most 32 more levels.
constexpr int kHalvingDepth = kMaxBvhDepth - 34;
// From which depth on the top is no longer divided: what is so lopsided is left to a subtree.
constexpr int kTopDepth = 40;

// Boxes of this part of the whole one, or longer, are long; they are few if one of so many is.
constexpr float kLong = 1.0f / 8;
constexpr std::uint32_t kFew = 64;

std::uint32_t subtreeSize(std::size_t count) {
    return std::max(4096u, static_cast<std::uint32_t>(count / 64));
}

float longestSide(const PrimBox& b) {
    return max(-b.negHi[0] - b.lo[0], max(-b.negHi[1] - b.lo[1], -b.negHi[2] - b.lo[2]));
}

Bounds boundsOf(const PrimBox& b) {
    return {{b.lo[0], b.lo[1], b.lo[2]}, {-b.negHi[0], -b.negHi[1], -b.negHi[2]}};
}

// The tree of a range. Costs are areas: a step into children costs as much as a primitive.
class Subtree {
public:
    Subtree(Lists& lists, const Range& root) : lists_(lists) {
        nodes.reserve(2 * std::size_t{root.count});
        nodes.push_back({boundsOf(root.box), 0, 0});
        Range r = root;
        cost = grow(0, r);
    }
    std::vector<BvhNode> nodes;
    double cost = 0;

private:
    double grow(std::uint32_t at, Range& r) {
        const double area = halfAreaOf(r.box, lists_.pad), asLeaf = area * r.count;
        const PrimBox* const prims = lists_.of(r);
        if (r.count > 1 && !r.split.exists()) splitExactly(r, lists_);
        const bool worthIt = r.split.exists() && r.split.cost + area < asLeaf;
        if (r.count == 1 || (!worthIt && r.count <= kUsualLeaf)) {
            makeLeaf(at, r);
            for (std::uint32_t i = 0; i < r.count; ++i) lists_.ids[r.first + i] = prims[i].id();
            return asLeaf;
        }
        Halves halves =
            r.split.exists() && r.depth < kHalvingDepth ? divide(r, lists_) : halve(r, lists_);
        const auto child = static_cast<std::uint32_t>(nodes.size());
        nodes[at].first = child;
        nodes.push_back({boundsOf(halves.left.box), 0, 0});
        nodes.push_back({boundsOf(halves.right.box), 0, 0});
        const double left = grow(child, halves.left);
        const double inTree = area + left + grow(child + 1, halves.right);
        // Boxes without area stay in a tree.
        if (inTree <= asLeaf || r.count > lists_.largestLeaf) return inTree;
        nodes.resize(child); // all in vain: rays that get here try nearly all primitives
        std::sort(lists_.ids + r.first, lists_.ids + r.first + r.count);
        makeLeaf(at, r);
        return asLeaf;
    }
    void makeLeaf(std::uint32_t at, const Range& r) {
        nodes[at].first = r.first, nodes[at].count = r.count;
    }

    Lists& lists_;
};

class Builder {
public:
    Builder(std::span<const Bounds> boxes, int threads, std::uint32_t largestLeaf)
        : count_(static_cast<std::uint32_t>(boxes.size())),
          // Few boxes are sorted before another thread has woken up.
          pool_(count_ < 2 * subtreeSize(count_) ? 1 : threads) {
        bvh_.primIds.resize(count_);
        lists_.ids = bvh_.primIds.data();
        lists_.largestLeaf = largestLeaf;
        lists_.prims.resize(count_), lists_.spare.resize(count_);
        Range root{0, count_, 0, false, kEmpty, {}, {}};
        const float longest = list(boxes, root.box);
        float extent = 0;
        for (std::size_t i = 0; i < 3; ++i)
            extent = max(extent, max(std::fabs(root.box.lo[i]), std::fabs(root.box.negHi[i])));
        lists_.pad = static_cast<double>(extent) * 0x1p-17; // RaySetup: twice 2^-19 on each side
        divideTop(root, sortOut(kLong * longestSide(root.box), longest));
        subtrees_.resize(ranges_.size());
        pool_.run(ranges_.size(), [&](std::size_t i, int) {
            subtrees_[i] = std::make_unique<Subtree>(lists_, ranges_[i]);
        });
        for (auto* list : {&lists_.prims, &lists_.spare}) // before the nodes are there twice
            RawVector<PrimBox>().swap(*list);
        join();
    }
    Bvh take() { return std::move(bvh_); }

private:
    // A node above the subtrees, or the root of one.
    struct Top {
        PrimBox box;
        std::uint32_t first, count;
        std::uint32_t left = 0; // children left, left + 1; 0: a subtree
        std::uint32_t subtree = 0;
    };

    // Boxes in parts, by all threads. Returns the longest side of one.
    float list(std::span<const Bounds> boxes, PrimBox& around) {
        constexpr std::uint32_t kTogether = 1 << 14;
        struct Part {
            PrimBox box = kEmpty;
            float longest = 0;
        };
        std::vector<Part> parts((count_ + kTogether - 1) / kTogether);
        pool_.run(parts.size(), [&](std::size_t number, int) {
            const auto first = static_cast<std::uint32_t>(number) * kTogether;
            Part part; // far from those of other threads
            for (std::uint32_t i = first; i < std::min(count_, first + kTogether); ++i) {
                const Vec3 lo = boxes[i].lo, hi = boxes[i].hi;
                lists_.prims[i] = {{lo.x, lo.y, lo.z, std::bit_cast<float>(i | PrimBox::kNormal)},
                                   {-hi.x, -hi.y, -hi.z, 0}};
                extend(part.box, lists_.prims[i]);
                part.longest = max(longestSide(lists_.prims[i]), part.longest);
            }
            parts[number] = part;
        });
        float longest = 0;
        for (const Part& part : parts) {
            extend(around, part.box);
            longest = max(part.longest, longest);
        }
        return longest;
    }

    // Long boxes among many short ones are taken off them one by one, by passes over all, and reach
    // through all nodes that they stay in: where they are few they get a tree of their own. Returns
    // how many there are, now at the end of the list.
    std::uint32_t sortOut(float atLeast, float longest) {
        if (count_ < kMany || !(longest >= atLeast)) return 0;
        RawVector<PrimBox>& prims = lists_.prims;
        std::uint32_t kept = count_;
        for (std::uint32_t i = 0; i < kept;) {
            if (!(longestSide(prims[i]) >= atLeast))
                ++i;
            else if (count_ - kept < count_ / kFew)
                std::swap(prims[i], prims[--kept]);
            else
                return 0;
        }
        return count_ - kept;
    }

    // The last ones of the list, so many, beside the others.
    void divideTop(const Range& root, std::uint32_t apart) {
        struct Open {
            std::uint32_t top;
            Range range;
        };
        std::vector<Open> level{{0, root}}, next;
        top_.push_back({root.box, root.first, root.count});
        if (apart > 0) {
            top_[0].left = 1;
            const Halves halves = partAt(root, root.count - apart, lists_);
            level = {{1, halves.left}, {2, halves.right}};
            for (const Open& o : level) top_.push_back({o.range.box, o.range.first, o.range.count});
        }
        for (Open& o : level) splitExactly(o.range, lists_);
        const std::uint32_t most = subtreeSize(count_);
        while (!level.empty()) {
            const auto isSubtree = [&](const Open& o) {
                return o.range.count <= most || !o.range.split.exists() ||
                       o.range.depth >= kTopDepth;
            };
            for (const Open& o : level) {
                if (!isSubtree(o)) continue;
                top_[o.top].subtree = static_cast<std::uint32_t>(ranges_.size());
                ranges_.push_back(o.range);
            }
            std::erase_if(level, isSubtree);
            std::vector<Halves> halves(level.size());
            const auto threads = static_cast<std::size_t>(pool_.threads());
            if (level.size() < 2 * threads && threads > 1)
                for (std::size_t i = 0; i < level.size(); ++i)
                    halves[i] = divideTogether(level[i].range, lists_, pool_);
            else
                pool_.run(level.size(),
                          [&](std::size_t i, int) { halves[i] = divide(level[i].range, lists_); });
            next.clear();
            for (std::size_t i = 0; i < level.size(); ++i) {
                top_[level[i].top].left = static_cast<std::uint32_t>(top_.size());
                for (const Range& r : {halves[i].left, halves[i].right}) {
                    next.push_back({static_cast<std::uint32_t>(top_.size()), r});
                    top_.push_back({r.box, r.first, r.count});
                }
            }
            std::swap(level, next);
        }
    }

    // Depth first. A node of the top whose subtrees cost more than a list is a list, too.
    void join() {
        std::vector<double> cost(top_.size());
        std::vector<bool> isList(top_.size());
        for (std::size_t end = top_.size(); end > 0; --end) {
            const std::size_t i = end - 1;
            const Top& t = top_[i];
            const double area = halfAreaOf(t.box, lists_.pad), asLeaf = area * t.count;
            cost[i] =
                t.left == 0 ? subtrees_[t.subtree]->cost : area + cost[t.left] + cost[t.left + 1];
            isList[i] = t.count <= lists_.largestLeaf &&
                        cost[i] > (t.count > kMany ? kWorthwhile : 1) * asLeaf;
            if (isList[i]) cost[i] = asLeaf;
        }
        std::size_t size = top_.size();
        for (const auto& s : subtrees_) size += s->nodes.size();
        bvh_.nodes.reserve(size);
        struct Open {
            std::uint32_t top, node;
        };
        std::vector<Open> open{{0, 0}};
        bvh_.nodes.push_back({});
        while (!open.empty()) {
            const auto [i, node] = open.back();
            open.pop_back();
            const Top& t = top_[i];
            if (isList[i]) {
                std::sort(&bvh_.primIds[t.first], &bvh_.primIds[t.first] + t.count);
                bvh_.nodes[node] = {boundsOf(t.box), t.first, t.count};
                continue;
            }
            if (t.left == 0) {
                append(subtrees_[t.subtree]->nodes, node);
                subtrees_[t.subtree].reset();
                continue;
            }
            const auto child = static_cast<std::uint32_t>(bvh_.nodes.size());
            bvh_.nodes[node] = {boundsOf(t.box), child, 0};
            bvh_.nodes.resize(child + 2);
            open.push_back({t.left + 1, child + 1});
            open.push_back({t.left, child});
        }
    }

    // A subtree whose root has its place already.
    void append(const std::vector<BvhNode>& nodes, std::uint32_t root) {
        const auto shift = static_cast<std::uint32_t>(bvh_.nodes.size()) - 1;
        const auto moved = [&](BvhNode n) {
            if (!n.isLeaf()) n.first += shift;
            return n;
        };
        bvh_.nodes[root] = moved(nodes[0]);
        for (std::size_t i = 1; i < nodes.size(); ++i) bvh_.nodes.push_back(moved(nodes[i]));
    }

    std::uint32_t count_;
    ThreadPool pool_;
    Lists lists_;
    std::vector<Top> top_;
    std::vector<Range> ranges_; // of the subtrees
    std::vector<std::unique_ptr<Subtree>> subtrees_;
    Bvh bvh_;
};

} // namespace

Bvh buildBvh(std::span<const Bounds> boxes, int threads, std::uint32_t largestLeaf) {
    return boxes.empty() ? Bvh{} : Builder(boxes, threads, largestLeaf).take();
}
