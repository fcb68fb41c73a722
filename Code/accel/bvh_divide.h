// How the plain builder (bvh_build.cpp) divides a range of primitives into two: from one list into
// the other, and into the bins of both halves, by one thread or by all.
#pragma once

#include "accel/bvh.h"
#include "accel/bvh_bins.h"
#include "base/parallel.h"
#include "base/raw_vector.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace bvh_build {

struct Range {
    std::uint32_t first, count;
    int depth;
    bool inSpare; // in which of the two lists it lies
    PrimBox box;
    BinGrid grid;
    Split split;
};

// Both lists, and what leaves hold, by position.
struct Lists {
    RawVector<PrimBox> prims, spare;
    std::uint32_t* ids = nullptr;
    double pad = 0; // by which rays see boxes larger
    std::uint32_t largestLeaf = kUsualLeaf;
    PrimBox* of(const Range& r, bool other = false) {
        return (r.inSpare != other ? spare : prims).data() + r.first;
    }
};

// A split by exact bounds of the centres.
inline void splitExactly(Range& r, Lists& lists) {
    const PrimBox* const prims = lists.of(r);
    std::array<float, 4> lo = {kHuge, kHuge, kHuge}, hi = {-kHuge, -kHuge, -kHuge};
    for (std::uint32_t i = 0; i < r.count; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lo[axis] = min(twiceCentre(prims[i], axis), lo[axis]);
            hi[axis] = max(twiceCentre(prims[i], axis), hi[axis]);
        }
    r.grid = BinGrid::over(lo, hi, r.count);
    if (r.grid.scale == std::array<float, 4>{}) return; // in one place, as duplicates are
    Bins bins;
    bins.clear(r.grid.bins);
    for (std::uint32_t i = 0; i < r.count; ++i) bins.add(r.grid, prims[i]);
    r.split = bestSplit(bins, r.grid.bins, r.count, lists.pad);
}

// A child's centres are within its box, and on its side of the cut: close enough for bins.
inline BinGrid childGrid(const Range& r, const PrimBox& box, bool right, std::uint32_t count) {
    std::array<float, 4> lo{}, hi{};
    for (std::size_t i = 0; i < 3; ++i) {
        lo[i] = max(r.grid.lo[i], 2 * box.lo[i]);
        hi[i] = min(r.grid.hi[i], -2 * box.negHi[i]);
    }
    const std::size_t axis = r.split.axis;
    const float cut = r.grid.lo[axis] + static_cast<float>(r.split.bin) / r.grid.scale[axis];
    if (right)
        lo[axis] = max(lo[axis], cut);
    else
        hi[axis] = min(hi[axis], cut);
    return BinGrid::over(lo, hi, count);
}

struct Halves {
    Range left, right;
    Range& side(std::size_t i) { return i == 0 ? left : right; }
    const Range& side(std::size_t i) const { return i == 0 ? left : right; }
};

inline Halves childrenOf(const Range& r) {
    const std::uint32_t nLeft = r.split.leftCount, nRight = r.count - nLeft;
    return {{r.first,
             nLeft,
             r.depth + 1,
             !r.inSpare,
             r.split.left,
             childGrid(r, r.split.left, false, nLeft),
             {}},
            {r.first + nLeft,
             nRight,
             r.depth + 1,
             !r.inSpare,
             r.split.right,
             childGrid(r, r.split.right, true, nRight),
             {}}};
}

// Of both children.
struct BothBins {
    Bins side[2];
    void clear(const Halves& halves) {
        for (std::size_t i = 0; i < 2; ++i)
            if (halves.side(i).count > 2) side[i].clear(halves.side(i).grid.bins);
    }
};

inline std::size_t sideOf(const Range& r, const PrimBox& prim) {
    return r.grid.binOf(prim, r.split.axis) < r.split.bin ? 0 : 1;
}

// Those from `first` on to the places from next[side] on.
inline void sortInto(const Range& r, std::uint32_t first, std::uint32_t last, Lists& lists,
                     std::array<std::uint32_t, 2> next, const Halves& halves, BothBins& bins) {
    const PrimBox* const from = lists.of(r);
    PrimBox* const to = lists.of(r, true);
    for (std::uint32_t i = first; i < last; ++i) {
        const std::size_t side = sideOf(r, from[i]);
        const Range& child = halves.side(side);
        to[next[side]++] = from[i];
        if (child.count > 2) bins.side[side].add(child.grid, from[i]);
    }
}

inline void chooseSplits(Halves& halves, const BothBins& bins, Lists& lists) {
    for (std::size_t side = 0; side < 2; ++side) {
        Range& child = halves.side(side);
        const PrimBox* const prims = lists.of(child);
        if (child.count == 2)
            child.split = splitOfTwo(child.grid, prims[0], prims[1], lists.pad);
        else if (child.count > 2)
            child.split = bestSplit(bins.side[side], child.grid.bins, child.count, lists.pad);
    }
}

inline Halves divide(const Range& r, Lists& lists) {
    Halves out = childrenOf(r);
    BothBins bins;
    bins.clear(out);
    sortInto(r, 0, r.count, lists, {0, out.left.count}, out, bins);
    chooseSplits(out, bins, lists);
    return out;
}

// The same by all threads, in parts.
inline Halves divideTogether(const Range& r, Lists& lists, ThreadPool& pool) {
    constexpr std::uint32_t kTogether = 1 << 14;
    struct Part {
        std::array<std::uint32_t, 2> count{}, next{};
        BothBins bins;
    };
    Halves out = childrenOf(r);
    std::vector<Part> parts((r.count + kTogether - 1) / kTogether);
    const auto forParts = [&](const auto& job) {
        pool.run(parts.size(), [&](std::size_t i, int) {
            const auto first = static_cast<std::uint32_t>(i) * kTogether;
            job(parts[i], first, std::min(r.count, first + kTogether));
        });
    };
    forParts([&](Part& part, std::uint32_t first, std::uint32_t last) {
        const PrimBox* const from = lists.of(r);
        for (std::uint32_t i = first; i < last; ++i) ++part.count[sideOf(r, from[i])];
    });
    std::array<std::uint32_t, 2> next{0, out.left.count};
    for (Part& part : parts) {
        part.next = next;
        for (std::size_t side = 0; side < 2; ++side) next[side] += part.count[side];
    }
    forParts([&](Part& part, std::uint32_t first, std::uint32_t last) {
        part.bins.clear(out);
        sortInto(r, first, last, lists, part.next, out, part.bins);
    });
    BothBins bins;
    bins.clear(out);
    for (const Part& part : parts)
        for (std::size_t side = 0; side < 2; ++side)
            if (out.side(side).count > 2)
                bins.side[side].add(part.bins.side[side], out.side(side).grid.bins);
    chooseSplits(out, bins, lists);
    return out;
}

// The first ones of a range, so many, and the others.
inline Halves partAt(const Range& r, std::uint32_t leftCount, Lists& lists) {
    Halves out{r, r};
    out.left.count = leftCount;
    out.right.first += out.left.count, out.right.count -= out.left.count;
    for (Range* half : {&out.left, &out.right}) {
        ++half->depth;
        half->box = kEmpty;
        const PrimBox* const prims = lists.of(*half);
        for (std::uint32_t i = 0; i < half->count; ++i) extend(half->box, prims[i]);
        half->split = {};
    }
    return out;
}

// Where no split separates the centres, any two halves are as good.
inline Halves halve(const Range& r, Lists& lists) { return partAt(r, r.count / 2, lists); }

} // namespace bvh_build
