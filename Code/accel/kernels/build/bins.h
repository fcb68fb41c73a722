// Boxes, bins and the choice of a split by the surface area heuristic (Wald 2007), for the three
// axes at once: lane = axis.
#pragma once

#include "accel/kernels/build/box.h"
#include "accel/kernels/build/build.h"
#include "simd/region.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <immintrin.h>
#include <limits>

LANES_BEGIN
namespace build {
using namespace kernels::build;

constexpr float kHuge = std::numeric_limits<float>::max();

inline Box emptyBox() { return Box::of(_mm_set1_ps(kHuge), _mm_set1_ps(kHuge)); }
inline __m128 negated(__m128 v) { return _mm_sub_ps(_mm_setzero_ps(), v); }
inline __m128 twiceCentre(Box p) { return _mm_sub_ps(p.lo(), p.negHi()); }
inline Box pointBox(__m128 p) { return Box::of(p, negated(p)); }

// Products of two sides: xy, yz, zx. Both signs of a size do.
inline __m128 sideProducts(Box b) {
    const __m128 size = _mm_add_ps(b.lo(), b.negHi());
    return _mm_mul_ps(size, _mm_shuffle_ps(size, size, _MM_SHUFFLE(3, 0, 2, 1)));
}
inline float halfArea(Box b) {
    const __m128 p = sideProducts(b);
    const __m128 xyyz = _mm_add_ss(p, _mm_shuffle_ps(p, p, 1));
    return _mm_cvtss_f32(_mm_add_ss(xyyz, _mm_movehl_ps(p, p)));
}
// Of three boxes, in the order of halfArea().
inline __m128 halfAreas(Box a, Box b, Box c) {
    const __m128 p = sideProducts(a), q = sideProducts(b), r = sideProducts(c);
    const __m128 low = _mm_unpacklo_ps(p, q), high = _mm_unpackhi_ps(p, q);
    const __m128 xy = _mm_shuffle_ps(low, r, _MM_SHUFFLE(0, 0, 1, 0));
    const __m128 yz = _mm_shuffle_ps(low, r, _MM_SHUFFLE(1, 1, 3, 2));
    const __m128 zx = _mm_shuffle_ps(high, r, _MM_SHUFFLE(2, 2, 1, 0));
    return _mm_add_ps(_mm_add_ps(xy, yz), zx);
}

inline WideBinGrid gridOver(__m128 lo, __m128 hi, std::uint32_t count) {
    const auto bins = std::min(static_cast<std::uint32_t>(kBins), 4 + count / 20);
    const __m128 extent = _mm_sub_ps(hi, lo), number = _mm_set1_ps(static_cast<float>(bins));
    const __m128 some = _mm_cmpgt_ps(extent, _mm_set1_ps(0x1p-100f));
    WideBinGrid grid;
    _mm_store_ps(grid.lo.data(), lo), _mm_store_ps(grid.hi.data(), hi);
    _mm_store_ps(grid.scale.data(), _mm_and_ps(some, _mm_div_ps(number, extent)));
    _mm_store_ps(grid.last.data(), _mm_sub_ps(number, _mm_set1_ps(1)));
    return grid;
}

WideBinGrid gridOver(const PrimBox& centres, std::uint32_t count) {
    const Box b = Box::load(centres);
    return gridOver(b.lo(), negated(b.negHi()), count);
}

// Position in bins, not yet held within them.
inline __m128 positionIn(const WideBinGrid& grid, Box p) {
    return _mm_mul_ps(_mm_sub_ps(twiceCentre(p), _mm_load_ps(grid.lo.data())),
                      _mm_load_ps(grid.scale.data()));
}

inline void clear(WideBins& bins, std::uint32_t used) {
    const Box empty = emptyBox();
    for (auto& axis : bins.box)
        for (std::uint32_t b = 0; b < used; ++b) empty.store(axis[b]);
    for (std::uint32_t b = 0; b < used; ++b) bins.count[b].fill(0);
}

// The bins that a box falls into. 16 bytes per bin of counts, twice that per bin of boxes: one
// number addresses both.
inline __m128i placeIn(const WideBinGrid& grid, Box p) {
    const __m128 inside = _mm_min_ps(_mm_max_ps(positionIn(grid, p), _mm_setzero_ps()),
                                     _mm_load_ps(grid.last.data()));
    return _mm_slli_epi32(_mm_cvttps_epi32(inside), 4);
}

inline void addAt(WideBins& bins, std::size_t axis, std::size_t place, Box p) {
    auto* const box = reinterpret_cast<std::byte*>(bins.box[axis].data()) + 2 * place;
    Box grown = Box::load(*reinterpret_cast<PrimBox*>(box));
    grown.extend(p);
    grown.store(*reinterpret_cast<PrimBox*>(box));
    auto* const count = reinterpret_cast<std::byte*>(bins.count.data()) + place + 4 * axis;
    ++*reinterpret_cast<std::uint32_t*>(count);
}

inline void add(WideBins& bins, const WideBinGrid& grid, Box p) {
    const __m128i at = placeIn(grid, p);
    const auto xy = static_cast<std::uint64_t>(_mm_cvtsi128_si64(at));
    addAt(bins, 0, static_cast<std::uint32_t>(xy), p);
    addAt(bins, 1, xy >> 32, p);
    addAt(bins, 2, static_cast<std::uint32_t>(_mm_extract_epi32(at, 2)), p);
}

// First all places, then all bins: a bin that is read waits for every store before it whose address
// isn't known yet, since it may be the same bin.
constexpr std::uint32_t kBlock = 256;
inline void addBlock(WideBins& bins, const WideBinGrid& grid, const PrimBox* from,
                     std::uint32_t count) {
    alignas(16) std::uint32_t places[kBlock][4];
    for (std::uint32_t i = 0; i < count; ++i)
        _mm_store_si128(reinterpret_cast<__m128i*>(places[i]), placeIn(grid, Box::load(from[i])));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Box p = Box::load(from[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) addAt(bins, axis, places[i][axis], p);
    }
}

inline __m128i countsOf(const WideBins& bins, std::uint32_t b) {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(bins.count[b].data()));
}

// Adds what others have binned in the same grid.
void mergeBins(WideBins& to, const WideBins& from, std::uint32_t used) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::uint32_t b = 0; b < used; ++b) {
            Box grown = Box::load(to.box[axis][b]);
            grown.extend(Box::load(from.box[axis][b]));
            grown.store(to.box[axis][b]);
        }
    for (std::uint32_t b = 0; b < used; ++b)
        _mm_store_si128(reinterpret_cast<__m128i*>(to.count[b].data()),
                        _mm_add_epi32(countsOf(to, b), countsOf(from, b)));
}

// The cheapest split between two bins: areas weighted with numbers of triangles.
void chooseSplit(BuildRange& r, const WideBins& bins) {
    const std::uint32_t used = r.grid.bins();
    __m128 rightCost[kBins];
    Box x = emptyBox(), y = x, z = x;
    __m128i count = _mm_setzero_si128();
    for (std::uint32_t b = used - 1; b > 0; --b) {
        x.extend(Box::load(bins.box[0][b]));
        y.extend(Box::load(bins.box[1][b]));
        z.extend(Box::load(bins.box[2][b]));
        count = _mm_add_epi32(count, countsOf(bins, b));
        rightCost[b] = _mm_mul_ps(halfAreas(x, y, z), _mm_cvtepi32_ps(count));
    }
    x = y = z = emptyBox();
    count = _mm_setzero_si128();
    const __m128i all = _mm_set1_epi32(static_cast<int>(r.count));
    __m128 least = _mm_set1_ps(std::numeric_limits<float>::infinity()), cut = _mm_setzero_ps();
    for (std::uint32_t b = 1; b < used; ++b) {
        x.extend(Box::load(bins.box[0][b - 1]));
        y.extend(Box::load(bins.box[1][b - 1]));
        z.extend(Box::load(bins.box[2][b - 1]));
        count = _mm_add_epi32(count, countsOf(bins, b - 1));
        // Nothing on one side: no split, and its cost is no number.
        const __m128i none =
            _mm_or_si128(_mm_cmpeq_epi32(count, _mm_setzero_si128()), _mm_cmpeq_epi32(count, all));
        const __m128 cost =
            _mm_add_ps(_mm_mul_ps(halfAreas(x, y, z), _mm_cvtepi32_ps(count)), rightCost[b]);
        const __m128 better = _mm_andnot_ps(_mm_castsi128_ps(none), _mm_cmplt_ps(cost, least));
        least = _mm_blendv_ps(least, cost, better);
        cut = _mm_blendv_ps(cut, _mm_set1_ps(static_cast<float>(b)), better);
    }
    alignas(16) std::array<float, 4> leastOf, cutOf;
    _mm_store_ps(leastOf.data(), least), _mm_store_ps(cutOf.data(), cut);
    WideBinSplit& split = r.split;
    split.axis = -1;
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (leastOf[axis] < best) best = leastOf[axis], split.axis = static_cast<int>(axis);
    if (split.axis < 0) return;
    const auto axis = static_cast<std::size_t>(split.axis);
    split.cut = cutOf[axis];
    split.leftCount = 0;
    Box left = emptyBox(), right = left;
    std::uint32_t b = 0;
    for (; b < static_cast<std::uint32_t>(split.cut); ++b) {
        left.extend(Box::load(bins.box[axis][b]));
        split.leftCount += bins.count[b][axis];
    }
    for (; b < used; ++b) right.extend(Box::load(bins.box[axis][b]));
    left.store(split.left), right.store(split.right);
}

} // namespace build
LANES_END
