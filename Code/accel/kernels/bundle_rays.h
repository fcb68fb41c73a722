// The rays of a bundle that are traced together. Around the dominant axis of their directions, rays
// from one point are points S = (x/z, y/z) of a plane, a packet is a rectangle in it and so is a
// bundle. Only rays with the same dominant axis and sign share a plane: a bundle is traced in
// rounds, and a ray is active in one of them.
#pragma once

#include "accel/kernels/bundle_gaps.h"
#include "accel/kernels/bundle_packets.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/key_range.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/ray_lanes.h"
#include "accel/ray_setup.h"
#include "base/math.h"
#include "base/ray.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

LANES_BEGIN

template <Query Q> class BundleRays : private BundlePackets {
public:
    using BundlePackets::kMostRays;
    using BundlePackets::kPackets;
    using BundlePackets::origin;
    using BundlePackets::refuse;

    using Range = SlopeRange;
    struct Rect {
        Range x, y;
    };

    BundleRays(const WideMesh& mesh, const RaySpan& rays, Vec3 org)
        : BundlePackets(rays, org), mesh_(mesh) {}

    // `list`: numbers of rays, in ascending order, at most kMostRays.
    void load(std::span<const std::uint32_t> list) {
        BundlePackets::load(list);
        std::copy_n(traceable_, loaded_, left_);
    }

    // Makes the next rays active that can be traced together, and finds the range of their slopes;
    // false when none are left.
    bool nextRound() {
        int p = 0;
        while (p < loaded_ && left_[p] == 0) ++p;
        if (p == loaded_) return false;
        chooseAxis(p, std::countr_zero(left_[p]));
        unsigned chosen[kPackets];
        SlopeExtent xs, ys;
        for (int r = 0; r < loaded_; ++r) chosen[r] = left_[r] & slopes(r, left_[r], xs, ys);
        x = xs.range(), y = ys.range();
        if constexpr (Q == Query::Any) cutGaps(rawX_, rawY_, loaded_, chosen, x, y);
        for (int r = 0; r < loaded_; ++r) left_[r] &= ~chosen[r];
        activate(chosen);
        return true;
    }

    // Behind nextRound(), for bundles that come near the mesh: the packets and their rectangles.
    void setUp() {
        leastBelow = kInfinityF;
        bool endless = true;
        for (int q = 0; q < packets; ++q) {
            const int p = packet_[q];
            const Mask on = maskOf(active[q]);
            const int first = std::countr_zero(active[q]);
            const auto spread = [&](const float(&raw)[W]) {
                return select(on, Floats::load(raw), Floats(raw[first]));
            };
            const Floats sx = spread(rawX_[p]), sy = spread(rawY_[p]);
            sx.store(Sx[q]), sy.store(Sy[q]);
            endless &= setRange(p, q, on, first, spread(rawZ_[p]));
        }
        centreX = 0.5f * (x.lo + x.hi), centreY = 0.5f * (y.lo + y.hi);
        halfX = 0.5000001f * (x.hi - x.lo) + 1e-7f;
        halfY = 0.5000001f * (y.hi - y.lo) + 1e-7f;
        slopeSum =
            ::max(std::fabs(x.lo), std::fabs(x.hi)) + ::max(std::fabs(y.lo), std::fabs(y.hi));
        // What roughInverse() is off by at the rim of the rectangle, and a few roundings.
        const float rough = W == 16 ? 3e-4f : 2e-3f;
        const float padX = rough * halfX + 2e-6f, padY = rough * halfY + 2e-6f;
        for (int q = 0; q < packets; q += W) {
            const auto place = [q](const float(*s)[W], float* lo, float* hi, float* centre,
                                   float* half, float about, float pad) {
                const Floats least = smallestOfRows(s + q), most = largestOfRows(s + q);
                const Floats middle(about), room(pad), scale(0.5f);
                (least - middle - room).store(lo + q), (most - middle + room).store(hi + q);
                (scale * (least + most) - middle).store(centre + q);
                (scale * (most - least) * Floats(1.00001f) + Floats(2e-6f)).store(half + q);
            };
            place(Sx, rects.xLo, rects.xHi, rects.centreX, rects.halfX, centreX, padX);
            place(Sy, rects.yLo, rects.yHi, rects.centreY, rects.halfY, centreY, padY);
            const Floats far = endless ? Floats(std::numeric_limits<float>::max())
                                       : depthCuts(smallestOfRows(aboveLo + q));
            far.store(zFar + q);
        }
        for (int q = 0; q < packets; ++q) {
            (Floats::load(Sx[q]) - Floats(centreX)).store(relX[q]);
            (Floats::load(Sy[q]) - Floats(centreY)).store(relY[q]);
        }
        all = {{x.lo - centreX - padX, x.hi - centreX + padX},
               {y.lo - centreY - padY, y.hi - centreY + padY}};
    }

    // Answers of the active rays of packet q.
    template <class... Answers> void write(int q, Answers... answers) const {
        answer(packet_[q], active[q], answers...);
    }

    // Misses for the active rays.
    template <class Results> void writeMisses(const Results& results) const {
        for (int q = 0; q < packets; ++q) answerMisses(packet_[q], active[q], results);
    }

    // The active rays go into `to`, without an answer.
    void giveBack(std::vector<std::uint32_t>& to) const {
        for (int q = 0; q < packets; ++q)
            for (unsigned lanes = active[q]; lanes != 0; lanes &= lanes - 1)
                to.push_back(number(packet_[q], std::countr_zero(lanes)));
    }

    Vec3 direction(int q, int lane) const { return directionOf(packet_[q], lane); }

    // Packets whose rectangles overlap this one, a bit each.
    std::uint32_t overlapping(Range xs, Range ys) const {
        std::uint32_t found = 0;
        for (int q = 0; q < packets; q += W) {
            const auto meets = [q](const float* lo, const float* hi, Range range) {
                return (Floats(range.lo) <= Floats::load(hi + q)) &
                       (Floats::load(lo + q) <= Floats(range.hi));
            };
            found |= bits(meets(rects.xLo, rects.xHi, xs) & meets(rects.yLo, rects.yHi, ys)) << q;
        }
        return found;
    }

    // Of all rays of a packet, active or not.
    Floats lateralX(unsigned q) const { return Floats::load(dir_[kx][packet_[q]]); }
    Floats lateralY(unsigned q) const { return Floats::load(dir_[ky][packet_[q]]); }
    Floats depth(unsigned q) const { return Floats::load(rawZ_[packet_[q]]); }
    // Rays of a packet that meet what has these keys before they end.
    Mask reach(unsigned q, Floats key) const {
        return Floats(1.0f) / (key * depth(q)) < Floats::load(tMax[q]);
    }

    // ---- of the active rays; packets without any are left out

    std::size_t k = 2, kx = 0, ky = 1; // RaySetup's
    float sign = 1;
    Range x, y; // of the bundle
    Rect all;
    float centreX, centreY, halfX, halfY;
    float slopeSum; // of the largest |Sx| and |Sy|
    int packets = 0;
    unsigned active[kPackets];
    struct alignas(64) Rects { // of the packets, padded, about the bundle's centre
        float xLo[kPackets], xHi[kPackets], yLo[kPackets], yHi[kPackets];
        float centreX[kPackets], centreY[kPackets], halfX[kPackets], halfY[kPackets];
    } rects;
    alignas(64) float zFar[kPackets]; // behind it no ray of the packet asks
    alignas(64) float Sx[kPackets][W];
    float Sy[kPackets][W], relX[kPackets][W], relY[kPackets][W]; // rel: to centre
    float tMax[kPackets][W];
    // Keys that count are in (above, below), as t is in (tMin, tMax): KeyRange of
    // shape/triangle_queries.h. above is between these. Lanes without an active ray are copies of
    // another one that nothing is near enough for.
    float aboveLo[kPackets][W], aboveHi[kPackets][W], below[kPackets][W];
    float leastBelow;

private:
    void chooseAxis(int p, int lane) {
        const RaySetup ray(origin, directionOf(p, lane), mesh_.extent);
        k = ray.k, kx = ray.kx, ky = ray.ky, sign = ray.sign;
    }

    // Computes the slopes of a packet; returns the lanes of the chosen axis and sign, and extends
    // the extents by those of `wanted`.
    unsigned slopes(int p, unsigned wanted, SlopeExtent& xs, SlopeExtent& ys) {
        const Floats d = Floats::load(dir_[k][p]), dx = Floats::load(dir_[kx][p]),
                     dy = Floats::load(dir_[ky][p]);
        const Floats size = abs(d);
        const Mask beatsX = kx < k ? size >= abs(dx) : size > abs(dx); // equal: z, then y, then x
        const Mask beatsY = ky < k ? size >= abs(dy) : size > abs(dy);
        const unsigned negative = bits(d < Floats(0.0f));
        const Floats sx = dx / size, sy = dy / size;
        sx.store(rawX_[p]), sy.store(rawY_[p]), size.store(rawZ_[p]);
        const unsigned chosen = bits(beatsX & beatsY) & (sign < 0 ? negative : ~negative);
        const Mask on = maskOf(chosen & wanted);
        xs.extend(sx, on), ys.extend(sy, on);
        return chosen;
    }

    void activate(const unsigned* chosen) {
        packets = 0;
        for (int p = 0; p < loaded_; ++p) {
            if (chosen[p] == 0) continue;
            packet_[packets] = p;
            active[packets++] = chosen[p];
        }
    }

    // Lanes without a ray ask what lane `spare` asks. True when no ray has an end.
    bool setRange(int p, int q, Mask on, int spare, Floats z) {
        Floats lo, hi;
        if (isFull(p)) {
            const float* const tMins = &rays_.tMin[number(p, 0)];
            const float* const tMaxs = &rays_.tMax[number(p, 0)];
            prefetchAhead(tMins), prefetchAhead(tMaxs);
            lo = Floats::unaligned(tMins), hi = Floats::unaligned(tMaxs);
        } else {
            alignas(64) float tLo[W], tHi[W];
            for (int i = 0; i < W; ++i) {
                const std::uint32_t ray = number(p, isRay(p, i) ? i : spare);
                tLo[i] = rays_.tMin[ray], tHi[i] = rays_.tMax[ray];
            }
            lo = Floats::load(tLo), hi = Floats::load(tHi);
        }
        hi.store(tMax[q]);
        const Floats zero(0.0f), never(kInfinityF);
        Floats overLo(zero), overHi(zero), under(never);
        // For most rays without an end (0, infinity), which takes long to compute.
        const bool endless = bits((lo == zero) & (hi == never)) == (1u << W) - 1;
        if (!endless) {
            boundsAtEnd(hi, z, overLo, overHi);
            under = keyBelow(lo, z);
            leastBelow = ::min(smallest(under), leastBelow);
        }
        select(on, overLo, never).store(aboveLo[q]);
        if constexpr (Q == Query::Any) select(on, overHi, never).store(aboveHi[q]);
        under.store(below[q]);
        return endless;
    }

    // keyAbove() is at most 5 units of rounding from 1 / (t z).
    static void boundsAtEnd(Floats t, Floats z, Floats& lo, Floats& hi) {
        const Floats zero(0.0f), never(kInfinityF);
        const Floats key = Floats(1.0f) / (t * z);
        const Mask normal = (key > Floats(1e-30f)) & (key < Floats(1e30f));
        lo = select(normal, key * Floats(1 - 0x1p-21f), zero);
        hi = select(normal, key * Floats(1 + 0x1p-21f), never);
        const Mask endless = t == never, nothing = t <= zero;
        lo = select(nothing, never, lo);
        hi = select(endless, zero, hi);
    }

    const WideMesh& mesh_;
    unsigned left_[kPackets]; // rays that no round has had
    int packet_[kPackets];    // of the active ones
    alignas(64) float rawX_[kPackets][W], rawY_[kPackets][W], rawZ_[kPackets][W];
};

LANES_END
