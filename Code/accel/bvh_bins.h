// Bins of the plain builder (bvh_build.cpp): primitives by their centres, for the three axes at
// once, and the choice of a split between them by the surface area heuristic (Wald 2007).
#pragma once

#include "accel/prim_box.h"
#include "base/math.h"
#include "base/vec.h"

#include <algorithm>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace bvh_build {

inline constexpr std::uint32_t kBins = 16;

inline constexpr float kHuge = std::numeric_limits<float>::max();
inline constexpr PrimBox kEmpty = {{kHuge, kHuge, kHuge, kHuge}, {kHuge, kHuge, kHuge, kHuge}};

inline void extend(PrimBox& to, const PrimBox& by) {
#if defined(__SSE2__)
    const auto least = [](std::array<float, 4>& a, const std::array<float, 4>& b) {
        _mm_store_ps(a.data(), _mm_min_ps(_mm_load_ps(a.data()), _mm_load_ps(b.data())));
    };
    least(to.lo, by.lo), least(to.negHi, by.negHi);
#else
    for (std::size_t i = 0; i < 4; ++i) {
        to.lo[i] = min(to.lo[i], by.lo[i]);
        to.negHi[i] = min(to.negHi[i], by.negHi[i]);
    }
#endif
}

inline float twiceCentre(const PrimBox& p, std::size_t axis) { return p.lo[axis] - p.negHi[axis]; }

// As rays see a box: larger by their rounding (RaySetup), `pad` on both sides together.
inline double halfAreaOf(const PrimBox& box, double pad) {
    const auto side = [&](std::size_t i) {
        return static_cast<double>(-box.negHi[i]) - static_cast<double>(box.lo[i]) + pad;
    };
    return side(0) * side(1) + side(1) * side(2) + side(2) * side(0);
}

// Where bins lie, in doubled centres. What is outside falls into the outmost ones, so an estimate
// of the bounds will do.
struct alignas(16) BinGrid {
    std::array<float, 4> lo, hi, scale; // scale 0: an axis without extent
    std::uint32_t bins;

    static BinGrid over(const std::array<float, 4>& lo, const std::array<float, 4>& hi,
                        std::uint32_t count) {
        BinGrid g{lo, hi, {}, std::min(kBins, 6 + count / 8)};
        for (std::size_t i = 0; i < 3; ++i)
            g.scale[i] =
                hi[i] - lo[i] > 0x1p-100f ? static_cast<float>(g.bins) / (hi[i] - lo[i]) : 0;
        return g;
    }
    std::uint32_t binOf(const PrimBox& p, std::size_t axis) const {
        const float position = (twiceCentre(p, axis) - lo[axis]) * scale[axis];
        return position > 0
                   ? static_cast<std::uint32_t>(min(position, static_cast<float>(bins - 1)))
                   : 0;
    }
    // The same for all axes; the fourth number means nothing.
    std::array<std::uint32_t, 4> binsOf(const PrimBox& p) const {
#if defined(__SSE2__)
        const __m128 centre = _mm_sub_ps(_mm_load_ps(p.lo.data()), _mm_load_ps(p.negHi.data()));
        const __m128 position =
            _mm_mul_ps(_mm_sub_ps(centre, _mm_load_ps(lo.data())), _mm_load_ps(scale.data()));
        const __m128 inside = _mm_min_ps(_mm_max_ps(position, _mm_setzero_ps()),
                                         _mm_set1_ps(static_cast<float>(bins - 1)));
        alignas(16) std::array<std::uint32_t, 4> at;
        _mm_store_si128(reinterpret_cast<__m128i*>(at.data()), _mm_cvttps_epi32(inside));
        return at;
#else
        return {binOf(p, 0), binOf(p, 1), binOf(p, 2), 0};
#endif
    }
};

struct Bins {
    PrimBox box[3][kBins];
    std::uint32_t count[3][kBins];

    void clear(std::uint32_t used) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::fill_n(box[axis], used, kEmpty);
            std::fill_n(count[axis], used, 0u);
        }
    }
    // What others hold, of the same grid.
    void add(const Bins& others, std::uint32_t used) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::uint32_t b = 0; b < used; ++b) {
                extend(box[axis][b], others.box[axis][b]);
                count[axis][b] += others.count[axis][b];
            }
    }
    void add(const BinGrid& grid, const PrimBox& p) {
        const std::array<std::uint32_t, 4> at = grid.binsOf(p);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t b = at[axis];
            extend(box[axis][b], p);
            ++count[axis][b];
        }
    }
};

struct Split {
    double cost = std::numeric_limits<double>::infinity(); // area-weighted primitive count
    std::size_t axis = 0;
    std::uint32_t bin = 0; // primitives of bins < bin go left
    std::uint32_t leftCount = 0;
    PrimBox left = kEmpty, right = kEmpty;
    bool exists() const { return leftCount > 0; }
};

// Cheapest split over the bins of all three axes.
inline Split bestSplit(const Bins& bins, std::uint32_t used, std::uint32_t count, double pad) {
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // Cuts on both sides of an empty bin are the same one: the first counts.
        std::array<double, kBins> rightCost;
        PrimBox box = kEmpty;
        std::uint32_t n = 0;
        double cost = 0;
        for (std::uint32_t b = used - 1; b > 0; --b) {
            if (bins.count[axis][b] > 0) {
                extend(box, bins.box[axis][b]);
                n += bins.count[axis][b];
                cost = halfAreaOf(box, pad) * n;
            }
            rightCost[b] = cost;
        }
        box = kEmpty, n = 0;
        for (std::uint32_t b = 1; b < used; ++b) {
            if (bins.count[axis][b - 1] == 0) continue;
            extend(box, bins.box[axis][b - 1]);
            n += bins.count[axis][b - 1];
            if (n == count) break;
            cost = halfAreaOf(box, pad) * n + rightCost[b];
            if (cost < best.cost) best = {cost, axis, b, n, box, kEmpty};
        }
    }
    if (best.exists())
        for (std::uint32_t b = best.bin; b < used; ++b) extend(best.right, bins.box[best.axis][b]);
    return best;
}

// bestSplit() of the bins of two primitives.
inline Split splitOfTwo(const BinGrid& grid, const PrimBox& p, const PrimBox& q, double pad) {
    const std::array<std::uint32_t, 4> a = grid.binsOf(p), b = grid.binsOf(q);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (a[axis] == b[axis]) continue;
        const bool isInOrder = a[axis] < b[axis];
        const PrimBox &left = isInOrder ? p : q, &right = isInOrder ? q : p;
        const double cost = halfAreaOf(left, pad) + halfAreaOf(right, pad);
        if (!(cost < std::numeric_limits<double>::infinity())) continue;
        return {cost, axis, min(a[axis], b[axis]) + 1, 1, left, right};
    }
    return {};
}

} // namespace bvh_build
