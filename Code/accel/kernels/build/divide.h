// Passes over the triangles of a range.
#pragma once

#include "accel/kernels/build/bins.h"
#include "accel/kernels/build/build.h"
#include "base/vec.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace kernels::build {

inline Box boxOf(const BuildInput& in, std::uint32_t i) {
    if (in.triangles.empty()) {
        const Vec3 &lo = in.boxes[i].lo, &hi = in.boxes[i].hi;
        return {Four{lo.x, lo.y, lo.z}, Four{-hi.x, -hi.y, -hi.z}};
    }
    Box b = Box::empty();
    for (const std::uint32_t corner : in.triangles[i]) {
        const Vec3& v = in.points[corner];
        b.extend(Box::ofPoint(Four{v.x, v.y, v.z}));
    }
    return b;
}

// Lists the boxes of primitives first .. first + count - 1; their bounds and those of the doubled
// centres.
inline void makePrims(const BuildInput& in, std::uint32_t first, std::uint32_t count, PrimBox& box,
                      PrimBox& centres) {
    Box around = Box::empty(), middle = around;
    for (std::uint32_t i = first; i < first + count; ++i) {
        Box b = boxOf(in, i);
        around.extend(b);
        middle.extend(Box::ofPoint(b.twiceCentre()));
        b.lo[3] = std::bit_cast<float>(i | PrimBox::kNormal);
        b.store(in.lists->prims[i]);
    }
    around.store(box), middle.store(centres);
}

inline void fillBins(const WideBinGrid& grid, const PrimBox* from, std::uint32_t count,
                     WideBins& bins) {
    clear(bins, grid.bins());
    for (std::uint32_t i = 0; i < count; i += kBlock)
        addBlock(bins, grid, from + i, std::min(kBlock, count - i));
}

// On which side of its cut a range has a box: by the position in bins on one axis, as positionIn().
class Cut {
public:
    explicit Cut(const BuildRange& r)
        : axis_(static_cast<std::size_t>(r.split.axis)), lo_(r.grid.lo[axis_]),
          scale_(r.grid.scale[axis_]), cut_(r.split.cut) {}
    bool isLeft(const PrimBox& p) const {
        return !((p.lo[axis_] - p.negHi[axis_] - lo_) * scale_ >= cut_);
    }

private:
    std::size_t axis_;
    float lo_, scale_, cut_;
};

// The children of a split range. Their centres are within their boxes, and on their sides of the
// cut: close enough for bins, and known before anyone has looked at a triangle.
inline void makeChildren(const BuildRange& r, BuildRange& left, BuildRange& right) {
    const Box parts[2] = {Box::load(r.split.left), Box::load(r.split.right)};
    Four lo[2], hi[2];
    for (int side = 0; side < 2; ++side) {
        lo[side] = most(loadFour(r.grid.lo.data()), 2.0f * parts[side].lo);
        hi[side] = least(loadFour(r.grid.hi.data()), -2.0f * parts[side].negHi);
    }
    const auto axis = static_cast<std::size_t>(r.split.axis);
    const float cut = r.grid.lo[axis] + r.split.cut / r.grid.scale[axis];
    hi[0][axis] = std::min(cut, hi[0][axis]);
    lo[1][axis] = std::max(cut, lo[1][axis]);

    left.first = r.first, left.count = r.split.leftCount;
    right.first = r.first + left.count, right.count = r.count - left.count;
    BuildRange* const kids[2] = {&left, &right};
    for (int side = 0; side < 2; ++side) {
        BuildRange& kid = *kids[side];
        kid.depth = static_cast<std::uint16_t>(r.depth + 1);
        kid.inSpare = !r.inSpare;
        parts[side].store(kid.box);
        kid.grid = gridOver(lo[side], hi[side], kid.count);
    }
}

// The children of a range: the left one's list grows from `low` upwards, the other one's from
// `high` downwards.
struct Sides {
    PrimBox* low;
    PrimBox* high;
    // No branches to guess: the sides come as they like.
    void add(const Box& p, std::ptrdiff_t isLeft) {
        const std::ptrdiff_t toHigh = high - low;
        p.store(low[toHigh & (isLeft - 1)]);
        low += isLeft, high -= 1 - isLeft;
    }
};

template <bool kPrefetch>
inline void sortBlock(const BuildInput& in, const BuildRange& r, const PrimBox* from,
                      std::uint32_t count, Sides& to) {
    const Cut cut(r);
    for (std::uint32_t i = 0; i < count; ++i) {
        to.add(Box::load(from[i]), cut.isLeft(from[i]));
        if constexpr (kPrefetch) __builtin_prefetch(in.triangles.data() + from[i].id());
    }
}

// Of a few, each goes into the bins of its child at once.
inline void divideFew(const BuildRange& r, const WideBinGrid* grids, const PrimBox* from,
                      std::uint32_t count, Sides to, WideBins (&bins)[2]) {
    const Cut cut(r);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Box p = Box::load(from[i]);
        const std::ptrdiff_t isLeft = cut.isLeft(from[i]);
        to.add(p, isLeft);
        const auto side = static_cast<std::size_t>(1 - isLeft);
        add(bins[side], grids[side], p);
    }
}

// Sorts triangles of a range into its children, the left ones from `left` on upwards, the others
// from `right` on downwards, and into the bins of these.
inline void divide(const BuildInput& in, const BuildRange& r, const WideBinGrid* grids,
                   const PrimBox* from, std::uint32_t count, PrimBox* left, PrimBox* right,
                   WideBins (&bins)[2]) {
    for (std::size_t side = 0; side < 2; ++side) clear(bins[side], grids[side].bins());
    Sides to{left, right};
    constexpr std::uint32_t kFew = 12;
    if (count < kFew) return divideFew(r, grids, from, count, to, bins);
    // Triples of numbers of this many triangles stay in the nearest cache until they are needed.
    constexpr std::uint32_t kPrefetched = 64;
    const bool prefetches = r.count <= kPrefetched && !in.triangles.empty();
    for (std::uint32_t i = 0; i < count; i += kBlock) {
        const std::uint32_t part = std::min(kBlock, count - i);
        const Sides before = to;
        if (prefetches)
            sortBlock<true>(in, r, from + i, part, to);
        else
            sortBlock<false>(in, r, from + i, part, to);
        addBlock(bins[0], grids[0], before.low, static_cast<std::uint32_t>(to.low - before.low));
        addBlock(bins[1], grids[1], to.high + 1, static_cast<std::uint32_t>(before.high - to.high));
    }
}

} // namespace kernels::build
