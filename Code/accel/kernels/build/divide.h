// Passes over the triangles of a range.
#pragma once

#include "accel/kernels/build/bins.h"
#include "accel/kernels/build/build.h"
#include "base/vec.h"
#include "simd/region.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <immintrin.h>

LANES_BEGIN
namespace build {
using namespace kernels::build;

template <class BoxOf>
inline void listBoxes(const BuildInput& in, std::uint32_t first, std::uint32_t count, PrimBox& box,
                      PrimBox& centres, BoxOf&& boxOf) {
    const __m128i last = _mm_setr_epi32(0, 0, 0, -1);
    Box all = emptyBox(), middle = all;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Box b = boxOf(i);
        all.extend(b);
        middle.extend(pointBox(twiceCentre(b)));
        const __m128i id = _mm_set1_epi32(static_cast<int>(i | PrimBox::kNormal));
        Box::of(_mm_castsi128_ps(_mm_blendv_epi8(_mm_castps_si128(b.lo()), id, last)), b.negHi())
            .store(in.lists->prims[i]);
    }
    all.store(box), middle.store(centres);
}

void makePrims(const BuildInput& in, std::uint32_t first, std::uint32_t count, PrimBox& box,
               PrimBox& centres) {
    listBoxes(in, first, count, box, centres, [&](std::uint32_t i) {
        Box b = emptyBox();
        for (const std::uint32_t corner : in.triangles[i]) {
            const Vec3& v = in.points[corner];
            b.extend(pointBox(_mm_setr_ps(v.x, v.y, v.z, 0)));
        }
        return b;
    });
}

void takeBoxes(const BuildInput& in, std::uint32_t first, std::uint32_t count, PrimBox& box,
               PrimBox& centres) {
    listBoxes(in, first, count, box, centres, [&](std::uint32_t i) {
        const Vec3 &lo = in.boxes[i].lo, &hi = in.boxes[i].hi;
        return Box::of(_mm_setr_ps(lo.x, lo.y, lo.z, 0), _mm_setr_ps(-hi.x, -hi.y, -hi.z, 0));
    });
}

void fillBins(const WideBinGrid& grid, const PrimBox* from, std::uint32_t count, WideBins& bins) {
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
void makeChildren(const BuildRange& r, BuildRange& left, BuildRange& right) {
    const Box parts[2] = {Box::load(r.split.left), Box::load(r.split.right)};
    __m128 lo[2], hi[2];
    for (int side = 0; side < 2; ++side) {
        const __m128 two = _mm_set1_ps(2);
        lo[side] = _mm_max_ps(_mm_load_ps(r.grid.lo.data()), _mm_mul_ps(two, parts[side].lo()));
        hi[side] = _mm_min_ps(_mm_load_ps(r.grid.hi.data()),
                              negated(_mm_mul_ps(two, parts[side].negHi())));
    }
    const auto axis = static_cast<std::size_t>(r.split.axis);
    const __m128 cut = _mm_set1_ps(r.grid.lo[axis] + r.split.cut / r.grid.scale[axis]);
    const __m128i onAxis =
        _mm_cmpeq_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(r.split.axis));
    const __m128 there = _mm_castsi128_ps(onAxis);
    hi[0] = _mm_blendv_ps(hi[0], _mm_min_ps(hi[0], cut), there);
    lo[1] = _mm_blendv_ps(lo[1], _mm_max_ps(lo[1], cut), there);

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
    void add(Box p, std::ptrdiff_t isLeft) {
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
        if constexpr (kPrefetch)
            _mm_prefetch(reinterpret_cast<const char*>(in.triangles.data() + from[i].id()),
                         _MM_HINT_T0);
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
void divide(const BuildInput& in, const BuildRange& r, const WideBinGrid* grids,
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

} // namespace build
LANES_END
