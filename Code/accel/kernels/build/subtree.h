// One subtree, depth first, on one thread.
#pragma once

#include "accel/kernels/build/bins.h"
#include "accel/kernels/build/build.h"
#include "accel/kernels/build/divide.h"
#include "accel/kernels/build/leaf.h"

#include <cstdint>
#include <vector>

namespace kernels::build {

// Fewer triangles than this are not split for their own sake.
constexpr std::uint32_t kSmallLeaf = 4;
// The leaves of a further split of what fits into one must have no more than this part of its area:
// they take two places of nodes, and rays as much time for few triangles as for many.
inline constexpr float kWorthwhile = 0.65f;
// What leaves have of boxes.
inline constexpr int kSingle = 1;
// From this depth on every split halves the list, which ends after at most 32 more levels.
constexpr std::uint32_t kHalvingDepth = kMaxTreeDepth - 34;

// With leaves of at most W triangles, or of one box.
template <int W> class Subtree {
public:
    Subtree(const BuildInput& in, Grown& grown) : in_(in), grown_(grown) {}

    void grow(const BuildRange& root) {
        BuildRange current = root;
        current.node = static_cast<std::uint32_t>(grown_.nodes.size());
        grown_.nodes.push_back(leafNode(current.box));
        std::vector<BuildRange> waiting;
        for (;;) {
            if (isLeaf(current) || isPair(current)) {
                if (waiting.empty()) return;
                current = waiting.back();
                waiting.pop_back();
                continue;
            }
            BuildRange& right = waiting.emplace_back();
            BuildRange left;
            if (current.depth < kHalvingDepth && hasSplit(current))
                split(current, left, right);
            else
                halve(current, left, right);
            const auto child = static_cast<std::uint32_t>(grown_.nodes.size());
            grown_.nodes[current.node].left = child;
            left.node = child, right.node = child + 1;
            grown_.nodes.resize(child + 2);
            grown_.nodes[child] = leafNode(left.box);
            grown_.nodes[child + 1] = leafNode(right.box);
            current = left;
        }
    }

private:
    PrimBox* listOf(const BuildRange& r, bool other = false) const {
        return in_.lists->of(r, other);
    }

    bool isLeaf(const BuildRange& r) {
        if (r.count > W) return false;
        if constexpr (W == kSingle) {
            grown_.nodes[r.node].leaf = grown_.leaves++;
            in_.ids[r.first] = listOf(r)->id();
            return true;
        } else
            return isWideLeaf(r);
    }

    bool isWideLeaf(const BuildRange& r) {
        if (r.count > kSmallLeaf && r.split.axis >= 0) {
            const float rest =
                Box::load(r.split.left).halfArea() + Box::load(r.split.right).halfArea();
            if (rest < kWorthwhile * Box::load(r.box).halfArea()) return false;
        }
        return makeLeaf<W>(in_, listOf(r), r, grown_);
    }

    // There is one way to divide two boxes, and half of all ranges have no more.
    bool isPair(const BuildRange& r) {
        if (W != kSingle || r.count != 2) return false;
        grown_.nodes[r.node].left = static_cast<std::uint32_t>(grown_.nodes.size());
        for (std::uint32_t i = 0; i < 2; ++i) {
            const PrimBox& prim = listOf(r)[i];
            grown_.nodes.push_back(leafNode(prim));
            grown_.nodes.back().leaf = grown_.leaves++;
            in_.ids[r.first + i] = prim.id();
        }
        return true;
    }

    // A split by estimated bounds may have failed where the true ones show one.
    bool hasSplit(BuildRange& r) const {
        if (r.split.axis < 0) splitExactly(r);
        return r.split.axis >= 0;
    }

    void splitExactly(BuildRange& r) const {
        const PrimBox* const prims = listOf(r);
        Box centres = Box::empty();
        for (std::uint32_t i = 0; i < r.count; ++i)
            centres.extend(Box::ofPoint(Box::load(prims[i]).twiceCentre()));
        r.grid = gridOver(centres, r.count);
        WideBins bins;
        fillBins(r.grid, prims, r.count, bins);
        chooseSplit(r, bins);
    }

    void split(const BuildRange& r, BuildRange& left, BuildRange& right) const {
        makeChildren(r, left, right);
        const WideBinGrid grids[2] = {left.grid, right.grid};
        WideBins bins[2];
        PrimBox* const to = listOf(r, true);
        divide(in_, r, grids, listOf(r), r.count, to, to + r.count - 1, bins);
        for (BuildRange* half : {&left, &right})
            if (W != kSingle || half->count > 2) chooseSplit(*half, bins[half == &right]);
    }

    // All centres in one place: any two halves are as good.
    void halve(const BuildRange& r, BuildRange& left, BuildRange& right) const {
        left = right = r;
        left.count = r.count / 2;
        right.first = r.first + left.count, right.count = r.count - left.count;
        for (BuildRange* half : {&left, &right}) {
            ++half->depth;
            Box box = Box::empty();
            const PrimBox* const prims = listOf(*half);
            for (std::uint32_t i = 0; i < half->count; ++i) box.extend(Box::load(prims[i]));
            box.store(half->box);
            half->split.axis = -1;
        }
    }

    const BuildInput& in_;
    Grown& grown_;
};

} // namespace kernels::build
