// The triangles of a leaf against the rays of a bundle. Triangles are set up W at a time and culled
// against the rectangles of the packets; then every pair (packet, triangle) that is left is tested,
// W rays at a time. The tests in front of the canonical hit are certain or exact: edges: as affine
// functions of S, with a bound of their and the canonical ones' rounding; where the sign is not
// certain, the canonical edge functions decide; depth: the key of a hit is between those of the
// triangle's nearest and farthest corner, and near that of the plane in float.
#pragma once

#include "accel/kernels/bundle_best.h"
#include "accel/kernels/bundle_block.h"
#include "accel/kernels/bundle_keys.h"
#include "accel/kernels/bundle_rays.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/wide_tree.h"
#include "simd/lanes.h"

#include <cstddef>
#include <cstdint>

LANES_BEGIN

template <Query Q> class BundleLeaf {
public:
    BundleLeaf(const WideMesh& mesh, const BundleRays<Q>& rays)
        : mesh_(mesh), rays_(rays), keys_(mesh, rays), best_(mesh, rays, keys_) {}

    // Behind BundleRays::nextRound().
    void start() {
        best_.start();
        pairs_ = 0;
        zCut_ = best_.depthLimit();
    }

    // Nothing behind it can be better for any ray; below 0: all rays are done.
    float zCut() const { return zCut_; }

    void test(WideRef ref) {
        const auto& leaf = mesh_.tree.at<WideLeaf<W>>(ref);
        if (!block_.setUp(rays_, leaf, best_.open(), zCut_)) return;
        hasPlanes_ = false;
        pairs_ += static_cast<std::size_t>(block_.pairs);
        if (!testPairs(leaf, keys_.placeOf(ref))) return;
        if constexpr (Q == Query::Any) best_.closePackets();
        zCut_ = best_.depthLimit();
    }

    // That have been tested.
    std::size_t pairs() const { return pairs_; }

    template <class Results> void finish(const Results& results) { best_.write(results); }

private:
    // Tests the pairs of the block; true when a ray has got a better hit.
    [[gnu::always_inline]] bool testPairs(const WideLeaf<W>& leaf, std::uint32_t firstPlace) {
        const BundleBlock<Q>& b = block_;
        bool better = false;
        for (int i = 0; i < b.pairs; ++i) {
            const unsigned q = b.pair[i] >> 4, j = b.pair[i] & 15;
            const Floats x = Floats::load(rays_.relX[q]), y = Floats::load(rays_.relY[q]);
            const auto edge = [&](int e) {
                return fma(x, Floats(b.edge[e][1][j]),
                           fma(y, Floats(b.edge[e][2][j]), Floats(b.edge[e][0][j])));
            };
            const Floats least = min(min(edge(0), edge(1)), edge(2));
            const float doubt = b.doubt[j];
            Mask inside = least >= Floats(-doubt);
            const unsigned unsure = bits(inside) & bits(least <= Floats(doubt)) & rays_.active[q];
            if ((unsure | (b.uncertain >> j & 1)) != 0) [[unlikely]]
                inside = keys_.containsRays(firstPlace + j, q);

            const Floats lo = best_.keyLo(q), hi = best_.keyHi(q);
            const Mask front = inside & (Floats(b.keyLo[j]) > hi);
            const unsigned may = bits(inside & (Floats(b.keyHi[j]) >= lo));
            const unsigned wide = (b.wide >> j & 1) != 0 ? ~0u : 0u;
            if ((may & (~bits(front) | wide)) != 0) [[unlikely]] {
                better |= compare(leaf, firstPlace, q, j, may);
                continue;
            }
            better |= bits(front) != 0;
            best_.accept(q, firstPlace + j, front, Floats(b.keyLo[j]), Floats(b.keyHi[j]));
        }
        return better;
    }

    // Rays that are inside and whose order of hits the bounds of the keys don't tell.
    [[gnu::noinline]] bool compare(const WideLeaf<W>& leaf, std::uint32_t firstPlace, unsigned q,
                                   unsigned j, unsigned lanes) {
        lanes &= best_.asking(q);
        if (lanes == 0) return false;
        const std::uint32_t place = firstPlace + j;
        bool better = false;
        if constexpr (Q == Query::Any) better = hide(place, q, j, lanes);
        if (lanes == 0) return better;
        if (!hasPlanes_) fillPlanes(leaf);
        Mask inside = maskOf(lanes);
        const Floats key = keys_.keysOf(planes_[j], Ints(place), q, inside);
        inside = inside & (key < Floats::load(rays_.below[q]));
        if constexpr (Q == Query::Any) {
            const Floats lo = best_.keyLo(q), hi = best_.keyHi(q);
            Mask hit = inside & (key > hi);
            const Mask open = inside & (lo <= key) & notGreater(key, hi) & (lo < hi);
            if (bits(open) != 0) hit = hit | (open & rays_.reach(q, key));
            best_.accept(q, place, hit, key, key);
            return better || bits(hit) != 0;
        } else {
            // Keys of hits that were left open, where they matter.
            const Floats lo = best_.keyLo(q), hi = best_.keyHi(q);
            const unsigned open = bits(inside & (lo < hi) & (key >= lo) & (key <= hi));
            if (open != 0) best_.settle(q, open);
            const Floats known = best_.keyHi(q);
            Mask hit = inside & (key > known);
            const unsigned equal = bits(inside & (key == known));
            if (equal != 0) [[unlikely]]
                hit = hit | maskOf(best_.lowerIds(q, place, equal));
            best_.accept(q, place, hit, key, key);
            return bits(hit) != 0;
        }
    }

    // Shadow rays for which the bounds of their own keys tell; others stay in `lanes`. Nearest hits
    // need the key of most in the end.
    bool hide(std::uint32_t place, unsigned q, unsigned j, unsigned& lanes) {
        const auto near = block_.keysNear(rays_, q, j);
        const Floats below = Floats::load(rays_.below[q]);
        const Mask hit = maskOf(lanes) & (near.lo > best_.keyHi(q)) & (near.hi < below);
        best_.accept(q, place, hit, near.lo, near.hi);
        lanes &= ~(bits(hit) | bits(near.hi < best_.keyLo(q)) | bits(near.lo >= below));
        return bits(hit) != 0;
    }

    [[gnu::noinline]] void fillPlanes(const WideLeaf<W>& leaf) {
        planes_.store(keys_.planesOf([&](int i, std::size_t axis) {
            return permute(Floats::load(leaf.point[axis]), Ints::bytes(leaf.corner[i]));
        }));
        hasPlanes_ = true;
    }

    const WideMesh& mesh_;
    const BundleRays<Q>& rays_;
    BundleKeys<Q> keys_;
    BundleBest<Q> best_;
    float zCut_ = 0;
    std::size_t pairs_ = 0;
    BundleBlock<Q> block_;
    bool hasPlanes_ = false; // of the leaf's triangles: only some leaves need them
    BundlePlaneList planes_;
};

LANES_END
