// A packet of W rays as PacketFacets and those who build on it ask it, and what its rays have in
// common.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_hulls.h"
#include "base/math.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

LANES_BEGIN

class PacketRays {
protected:
    PacketRays(const SolidTree& tree, const RaySpan& rays) : tree_(tree), rays_(rays) {}

    static constexpr std::uint32_t kPlane = W * sizeof(float); // bytes between a box's two planes
    static constexpr unsigned kAll = (1u << W) - 1;
    // Fewer rays than this look at a node one by one.
    static constexpr int kFewestForInterval = 6;

    Lines lines() const {
        const auto& [org, dir, tMin, tMax, inARow] = columns_;
        return {{org[0], org[1], org[2]},
                {dir[0], dir[1], dir[2]},
                length_,
                perLength_,
                perLength2_,
                slack_,
                tMin,
                bound_};
    }

    // Takes the first W rays of the order. Returns the lanes to be traced.
    template <Answer A, class Result>
    unsigned setUp(std::span<const std::uint32_t> order, const Result* results) {
        const std::size_t count = std::min<std::size_t>(W, order.size());
        // Made where they stay: a copy would be of some hundred bytes.
        new (&columns_) RayColumns(loadRays(rays_, order.data(), count, ray_));
        alignas(64) float t[W]; // long before they are loaded in one piece, which waits for all
        if constexpr (A == Answer::Closest)
            for (std::size_t i = 0; i < W; ++i) {
                const Hit& hit = results[ray_[i]];
                t[i] = hit.t, number_[i] = hit.shape;
            }
        new (&lanes_) RayLanes(columns_, tree_.extent);
        const unsigned asking = entering() & ((1u << count) - 1);
        if (asking == 0) return 0;
        if constexpr (A == Answer::Any)
            best_ = columns_.tMax;
        else
            best_ = Floats::load(t);
        bound_ = best_;
        zCut_ = lanes_.cutAt(best_);
        const Floats(&d)[3] = columns_.dir;
        const Floats length2 = fma(d[0], d[0], fma(d[1], d[1], d[2] * d[2])), one(1.0f);
        length_ = sqrt(length2);
        perLength_ = one / length_;
        perLength2_ = one / length2;
        slack_ = max(Floats(tree_.extent), lanes_.oMax) * Floats(0x1p-18f);
        const unsigned inRange = asking & bits(columns_.tMin < best_);
        if (inRange != 0) findInterval(inRange);
        return inRange;
    }

    // Lanes that enter the box of all solids, if they have one. Rounding is monotonic: the others
    // enter none of them.
    unsigned entering() const {
        if (!tree_.endless.empty()) return lanes_.traceable;
        Floats entry;
        return lanes_.traceable & lanes_.entering(tree_.around, lanes_.cutAt(columns_.tMax), entry);
    }

    // The ranges of origins and r, for packets into one octant.
    void findInterval(unsigned lanes) {
        together_ = std::popcount(lanes) >= kFewestForInterval;
        for (int axis = 0; axis < 3; ++axis) {
            lanes_.r[axis].store(rays1_.r[axis]);
            lanes_.nearOffset[axis].store(rays1_.nearOffset[axis]);
            lanes_.farOffset[axis].store(rays1_.farOffset[axis]);
            const unsigned backwards = bits(lanes_.r[axis] < Floats(0.0f));
            back_[axis] = backwards & lanes ? 1 : 0;
            const auto plane = static_cast<std::uint32_t>(2 * axis) * kPlane;
            select(lanes_.r[axis] < Floats(0.0f), Ints(plane + kPlane), Ints(plane))
                .store(rays1_.nearPlane[axis]);
            together_ &= (backwards & lanes) == 0 || (backwards & lanes) == lanes;
        }
        zCut_.store(rays1_.zCut);
        if (together_)
            findRanges(lanes);
        else
            zTop_ = largest(select(maskOf(lanes), zCut_, Floats(-1.0f)));
    }

    // All at once, the largest ones as the smallest of their negatives.
    void findRanges(unsigned lanes) {
        constexpr int kRanges = 16;
        alignas(64) float rows[kRanges][W], least[kRanges];
        const auto put = [&](int row, Floats x) {
            select(maskOf(lanes), x, Floats(kInfinityF)).store(rows[row]);
        };
        const auto negated = [](Floats x) { return flipSign(x, Floats(-0.0f)); };
        for (int axis = 0; axis < 3; ++axis) {
            put(axis, columns_.org[axis]), put(3 + axis, negated(columns_.org[axis]));
            put(6 + axis, lanes_.r[axis]), put(9 + axis, negated(lanes_.r[axis]));
            put(12 + axis, negated(lanes_.room[axis]));
        }
        put(15, negated(zCut_));
        for (int first = 0; first < kRanges; first += W)
            smallestOfRows(rows + first).store(least + first);
        for (int axis = 0; axis < 3; ++axis) {
            oLo_[axis] = least[axis], oHi_[axis] = -least[3 + axis];
            rLo_[axis] = least[6 + axis], rHi_[axis] = -least[9 + axis];
            mostPad_[axis] = -least[12 + axis];
        }
        zTop_ = -least[15];
    }

    // Nothing behind these t counts any more.
    void limit(Floats best) {
        best_ = best;
        bindTo(min(best, bound_));
    }
    void bindTo(Floats bound) {
        bound_ = bound;
        zCut_ = min(lanes_.cutAt(bound), zCut_);
        zCut_.store(rays1_.zCut);
        zTop_ = largest(select(maskOf(live_), zCut_, Floats(-1.0f)));
    }

    const SolidTree& tree_;
    const RaySpan& rays_;
    std::uint32_t ray_[W]; // of the lane
    unsigned live_ = 0;    // lanes that still ask
    RayColumns columns_;
    RayLanes lanes_;
    Floats length_, perLength_, perLength2_, slack_; // see Lines
    // t up to which hits count, and by which there is one for certain, known or not yet; the depth
    // behind which none counts.
    Floats best_, bound_, zCut_;
    std::uint32_t number_[W];
    // The same by ray.
    struct alignas(64) {
        float r[3][W], nearOffset[3][W], farOffset[3][W], zCut[W];
        std::uint32_t nearPlane[3][W]; // bytes from the start of a node; see kPlane
    } rays1_;
    bool together_ = false;
    std::size_t back_[3]; // of rays together: 1 where they go backwards along the axis
    float oLo_[3], oHi_[3], rLo_[3], rHi_[3], mostPad_[3], zTop_ = 0;
};

LANES_END
