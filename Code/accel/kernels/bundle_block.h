// The triangles of a leaf set up for the rays of a bundle, and the pairs (packet, triangle) that
// have to be tested: culled against the rectangles of the packets, in front of zCut.
#pragma once

#include "accel/kernels/bundle_rays.h"
#include "accel/kernels/queue_rays.h"
#include "simd/vectors3.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "simd/lanes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

template <Query Q> struct alignas(64) BundleBlock {
    static constexpr int kPackets = BundleRays<Q>::kPackets;

    // A column per triangle.
    float edge[3][3][W];      // edge e at S: edge[e][0] + x edge[e][1] + y edge[e][2]
    float doubt[W];           // the sign of an edge is certain beyond this
    float keyLo[W], keyHi[W]; // bounds of the key of any hit
    float normal[3][W], volume[W], slack[W]; // see keysNear()
    unsigned uncertain; // triangles that may be seen from their edge: the edges are no help
    unsigned wide;      // whose key is better computed at once, if it matters
    int pairs;
    alignas(64) std::uint32_t pair[kPackets * W + W]; // packet * 16 + triangle

    // Fills the block and its list of pairs; false when there are none.
    [[gnu::always_inline]] bool setUp(const BundleRays<Q>& rays, const WideLeaf<W>& leaf,
                                      std::uint32_t open, float zCut) {
        const Floats zero(0.0f), one(1.0f);
        const Corners v = cornersOf(rays, leaf);
        const Floats zMin = min(min(v.z[0], v.z[1]), v.z[2]);
        const Floats zMax = max(max(v.z[0], v.z[1]), v.z[2]);
        unsigned live = bits((zMax > zero) & (zMin <= Floats(zCut))) & ((1u << leaf.count) - 1);
        const unsigned close = bits(zMin <= Floats(kTooNear));

        // Where the corners are seen from the origin, about the centre of the rectangle.
        Floats x[3], y[3], seenX[3], seenY[3];
        for (int i = 0; i < 3; ++i) {
            x[i] = fnma(Floats(rays.centreX), v.z[i], v.x[i]);
            y[i] = fnma(Floats(rays.centreY), v.z[i], v.y[i]);
            const Floats inverse = roughInverse(v.z[i]);
            seenX[i] = x[i] * inverse, seenY[i] = y[i] * inverse;
        }
        const Floats xLo = min(min(seenX[0], seenX[1]), seenX[2]);
        const Floats xHi = max(max(seenX[0], seenX[1]), seenX[2]);
        const Floats yLo = min(min(seenY[0], seenY[1]), seenY[2]);
        const Floats yHi = max(max(seenY[0], seenY[1]), seenY[2]);
        const auto overlap = [&](Floats xLeast, Floats xMost, Floats yLeast, Floats yMost) {
            return close | (bits((xLo <= xMost) & (xHi >= xLeast)) &
                            bits((yLo <= yMost) & (yHi >= yLeast)));
        };
        live &= overlap(rays.all.x.lo, rays.all.x.hi, rays.all.y.lo, rays.all.y.hi);
        if (live == 0) return false;

        // Edge functions as affine functions of S - centre, turned so that inside is positive.
        // noise: Woop's vertices differ from exact ones by u (|S| z + 3 R) each, R the size of the
        // triangle about the rectangle, which moves an edge by u R (2 z |S| + 12 R); evaluation of
        // the affine form adds 27 u R^2 at most, without FMA. kLeast: see below.
        const Floats zSize = max(zMax, zero - zMin);
        Floats reach = zSize, size(0.0f);
        for (int i = 0; i < 3; ++i) {
            reach = max(reach, max(abs(v.x[i]), abs(v.y[i])));
            size = max(size, max(abs(x[i]), abs(y[i])));
        }
        size = fma(zSize, Floats(::max(rays.halfX, rays.halfY)), size);
        const Floats noise =
            fma(size, fma(zSize, Floats(2.2f * kUnit * rays.slopeSum), size * Floats(44 * kUnit)),
                Floats(kLeast));

        const Floats e1x = v.x[1] - v.x[0], e1y = v.y[1] - v.y[0], e1z = v.z[1] - v.z[0];
        const Floats e2x = v.x[2] - v.x[0], e2y = v.y[2] - v.y[0], e2z = v.z[2] - v.z[0];
        const Floats nx = e1y * e2z - e1z * e2y, ny = e1z * e2x - e1x * e2z,
                     nz = e1x * e2y - e1y * e2x;
        const Floats side = (nx * v.x[0] + ny * v.y[0]) + nz * v.z[0];
        const Floats longest =
            max(max(max(abs(e1x), abs(e1y)), max(abs(e1z), abs(e2x))), max(abs(e2y), abs(e2z)));
        uncertain = bits(notGreater(
            abs(side), fma(longest * longest, reach * Floats(48 * kUnit), Floats(kLeast))));
        nx.store(normal[0]), ny.store(normal[1]), nz.store(normal[2]), side.store(volume);
        select(longest > Floats(0x1p-50f), longest * longest * reach, Floats(kInfinityF))
            .store(slack);
        const Floats turn = zero - side;
        Floats at[3], alongX[3], alongY[3];
        for (int e = 0; e < 3; ++e) {
            const int i = (e + 1) % 3, k = (e + 2) % 3;
            at[e] = flipSign(fms(x[k], y[i], y[k] * x[i]), turn);
            alongX[e] = flipSign(fms(y[k], v.z[i], y[i] * v.z[k]), turn);
            alongY[e] = flipSign(fms(x[i], v.z[k], x[k] * v.z[i]), turn);
        }

        // Which packets overlap which triangles and are outside none of its edges.
        const Floats least = zero - noise;
        pairs = 0;
        std::uint32_t packets = open;
        if ((live & close) == 0) {
            const Mask on = maskOf(live);
            const auto range = [&](Floats lo, Floats hi) {
                return typename BundleRays<Q>::Range{smallest(select(on, lo, Floats(kInfinityF))),
                                                     largest(select(on, hi, Floats(-kInfinityF)))};
            };
            packets &= rays.overlapping(range(xLo, xHi), range(yLo, yHi));
        }
        for (; packets != 0; packets &= packets - 1) {
            const auto q = static_cast<std::size_t>(std::countr_zero(packets));
            const auto& r = rays.rects;
            unsigned wanted = live & overlap(r.xLo[q], r.xHi[q], r.yLo[q], r.yHi[q]);
            const Floats cx(r.centreX[q]), cy(r.centreY[q]), hx(r.halfX[q]), hy(r.halfY[q]);
            const auto most = [&](int e) {
                return fma(hx, abs(alongX[e]),
                           fma(hy, abs(alongY[e]), fma(cx, alongX[e], fma(cy, alongY[e], at[e]))));
            };
            wanted &= uncertain | bits(notGreater(least, min(min(most(0), most(1)), most(2))));
            if constexpr (Q == Query::Any) wanted &= bits(zMin <= Floats(rays.zFar[q]));
            storeChosen(wanted, kPair[q].data(), pair + pairs);
            pairs += std::popcount(wanted);
        }
        if (pairs == 0) return false;

        noise.store(doubt);
        for (int e = 0; e < 3; ++e) {
            at[e].store(edge[e][0]);
            alongX[e].store(edge[e][1]), alongY[e].store(edge[e][2]);
        }
        // A ray that containsRay() meets the triangle, up to 4 units of rounding across, between
        // its least and its largest depth, and so in front of the exit of its padded box: its key
        // is in [1/zMax (1 - 4u), 1/zMin].
        const Floats lo = (one / zMax) * Floats(0.999999f);
        const Floats hi = select(zMin > Floats(kTooNear), one / zMin, Floats(kInfinityF));
        lo.store(keyLo), hi.store(keyHi);
        const Floats below(rays.leastBelow);
        wide = ~bits(hi < (Q == Query::Any ? below : min(lo * Floats(kWide), below)));
        return true;
    }

    // Bounds of the keys of those rays of packet q that the triangle j contains, closer than those
    // of all its hits: normal times (S, 1) is volume times the key. Off by units of rounding times
    // the slack, of the volume: 48 in reckoning it (`uncertain`), 40 in the product, 8 as slopes
    // are rounded and 6 as corners are, and 39 where the canonical key of a ray that passes the
    // triangle by 13 units is clamped to its chord or its box.
    struct KeyBounds {
        Floats lo, hi;
    };
    KeyBounds keysNear(const BundleRays<Q>& rays, unsigned q, unsigned j) const {
        const Floats lo(keyLo[j]), hi(keyHi[j]);
        const float off = 192 * kUnit * slack[j], size = std::fabs(volume[j]);
        // In front of the origin as a whole, of some use, small enough to be added up, and not of
        // products that have no room below the smallest normal float.
        const bool isInFront = keyHi[j] < kInfinityF;
        const bool isNormal = size > 0x1p-100f && off * 16 < size;
        if (!isInFront || !isNormal || !(off * 4 < size * (1 - keyLo[j] / keyHi[j])))
            return {lo, hi};
        const Floats across =
            fma(Floats::load(rays.Sx[q]), Floats(normal[0][j]),
                fma(Floats::load(rays.Sy[q]), Floats(normal[1][j]), Floats(normal[2][j])));
        const Floats key = across * Floats(1 / volume[j]);
        const Floats most = key * Floats(off / size + 8 * kUnit);
        return {max(key - most, lo), min(key + most, hi)};
    }

private:
    static constexpr float kUnit = 0x1p-24f;  // of rounding
    static constexpr float kTooNear = 1e-30f; // for a quotient that is sure to be finite
    // More than a few products lose that have no room left below the smallest normal float.
    static constexpr float kLeast = 0x1p-120f; // a normal one: others take long
    // Keys of nearest hits on triangles that are deeper than this are computed at once.
    static constexpr float kWide = 1.02f;
    // The numbers of pairs, for storeChosen().
    alignas(64) static constexpr auto kPair = [] {
        std::array<std::array<std::uint32_t, W>, kPackets> numbers{};
        for (std::uint32_t q = 0; q < kPackets; ++q)
            for (std::uint32_t j = 0; j < W; ++j) numbers[q][j] = q << 4 | j;
        return numbers;
    }();

    struct Corners {
        Floats x[3], y[3], z[3]; // ShearedTriangle::v
    };
    static Corners cornersOf(const BundleRays<Q>& rays, const WideLeaf<W>& leaf) {
        const auto relative = [&](std::size_t axis) {
            return Floats::load(leaf.point[axis]) - Floats(rays.origin[axis]);
        };
        const Floats x = relative(rays.kx), y = relative(rays.ky),
                     z = relative(rays.k) * Floats(rays.sign);
        Corners c;
        for (int i = 0; i < 3; ++i) {
            const Ints at = Ints::bytes(leaf.corner[i]);
            c.x[i] = permute(x, at), c.y[i] = permute(y, at), c.z[i] = permute(z, at);
        }
        return c;
    }
};

LANES_END
