// What W rays meet of triangles that each of them is asked for: hits that are certain in float are
// taken at once, and the rest waits for canonical keys.
#pragma once

#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_answers.h"
#include "accel/kernels/queue_exact.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

template <Query Q> class LaneHits {
public:
    // Triangles that may wait.
    static constexpr std::uint32_t kMost = 2 * W;

    LaneHits(const WideMesh& mesh, const RaySpan& rays) : mesh_(mesh), rays_(rays) {}

    // Loads the rays order[0 .. count - 1].
    RayColumns load(const std::uint32_t* order, std::size_t count) {
        return loadRays(rays_, order, count, block_.ray);
    }
    std::uint32_t ray(int lane) const { return block_.ray[lane]; }
    void start(const RayColumns& columns, const RayAxes& axes, std::size_t count) {
        setUpAnswers<Q>(columns, axes, count, block_);
        zCut_ = Floats::load(block_.zCut);
        endless_ = bits(Floats::load(block_.below) == Floats(kInfinityF));
        hidden_ = 0;
        if (metCount_ != 0) forget(); // rays that were given up
        areTrianglesSetUp_ = false;
    }

    Floats zCut() const { return zCut_; } // nothing behind it can be a better hit
    unsigned hidden() const { return hidden_; }

    // Asks these lanes for a triangle.
    [[gnu::always_inline]] void ask(const RayColumns& columns, const RayAxes& axes,
                                    const Sheared& corners, const Edges& edges, WideRef leaf,
                                    std::uint32_t triangle, unsigned lanes) {
        const Judged judged = judge(corners, edges, axes.sign);
        if constexpr (Q == Query::Any) {
            hidden_ |= judged.certain(zCut_) & endless_ & lanes;
            lanes &= ~hidden_;
            if ((judged.candidates(zCut_) & lanes) == 0) return;
        }
        if (metCount_ == kMost) settle(columns, axes);
        // No branch: of rays that go apart one meets half the triangles.
        const Mask isCandidate = judged.mayBeHit(zCut_) & maskOf(lanes);
        const unsigned candidates = bits(isCandidate);
        if constexpr (Q == Query::Closest) {
            best_.consider(judged, isCandidate, maskOf(endless_), leaf, triangle);
            zCut_ = min(best_.farthest, zCut_);
        }
        met_[metCount_] = {leaf, triangle, candidates};
        metCount_ += candidates != 0;
    }

    // Writes the best hits, or whether there is one.
    template <class Results>
    void finish(const RayColumns& columns, const RayAxes& axes, const Results& results) {
        if (metCount_ != 0) {
            if constexpr (Q == Query::Closest) acceptNearest();
            settle(columns, axes);
            if (block_.open != 0) settleOpen(mesh_, rays_, block_);
        }
        if constexpr (Q == Query::Any)
            select(maskOf(hidden_), Ints(0u), Ints::load(block_.triangle)).store(block_.triangle);
        write(results);
    }
    // Misses, if nothing was asked.
    template <class Results> void write(const Results& results) const {
        writeAnswers(block_, mesh_.tree, results);
    }

private:
    // A triangle that some rays may meet.
    struct Met {
        WideRef leaf;
        std::uint32_t triangle; // number in the leaf
        unsigned candidates;
    };

    // Of the hits that are certain in float the one that ends first at the latest, between which
    // depths it is, and from where on there is another candidate.
    struct Best {
        Floats nearest = Floats(kInfinityF), farthest = Floats(kInfinityF);
        Floats rival = Floats(kInfinityF);
        Ints leaf = Ints(0u), triangle = Ints(0u);

        [[gnu::always_inline]] void consider(const Judged& judged, Mask isCandidate, Mask isEndless,
                                             WideRef inLeaf, std::uint32_t number) {
            const Floats inverse = Floats(1.0f) / judged.det, to = judged.farthest(inverse);
            const Floats from =
                max(judged.nearest(inverse), Floats(-kInfinityF)); // NaN may be near
            const Mask isBest = isCandidate & judged.certain() & isEndless & (to < farthest);
            rival = select(isCandidate, min(select(isBest, nearest, from), rival), rival);
            nearest = select(isBest, from, nearest), farthest = select(isBest, to, farthest);
            leaf = select(isBest, Ints(inLeaf), leaf);
            triangle = select(isBest, Ints(number), triangle);
        }
        // There is one, and no other comes near: without one both are infinite.
        Mask isAlone() const { return farthest < rival; }
    };

    void forget() {
        metCount_ = 0;
        if constexpr (Q == Query::Closest) best_ = Best();
    }

    // The keys of all that waits, but for what was accepted without one.
    [[gnu::noinline]] void settle(const RayColumns& columns, const RayAxes& axes) {
        if (!areTrianglesSetUp_) setUpTriangles(columns, axes, mesh_.extent, block_);
        areTrianglesSetUp_ = true;
        std::uint32_t n = 0;
        for (std::uint32_t m = 0; m < metCount_; ++m) {
            unsigned left = met_[m].candidates & ~(Q == Query::Any ? hidden_ : block_.open);
            for (; left != 0; left &= left - 1)
                pairs_[n++] = {static_cast<std::uint32_t>(std::countr_zero(left)), met_[m].leaf,
                               met_[m].triangle};
        }
        forget();
        if (n == 0) return;
        settlePairs<Q>(mesh_, rays_, &block_, {pairs_, n}, [&](std::uint32_t lane) {
            if constexpr (Q == Query::Any) hidden_ |= 1u << lane;
        });
        if constexpr (Q == Query::Closest) zCut_ = min(zCut_, Floats::load(block_.zCut));
    }

    // Rays whose nearest hit is certain without keys need but one, that of the hit.
    void acceptNearest() {
        const Mask open = best_.isAlone() & (Floats::load(block_.key) == Floats(0.0f));
        block_.open = bits(open);
        select(open, best_.leaf, Ints::load(block_.bestLeaf)).store(block_.bestLeaf);
        select(open, best_.triangle, Ints::load(block_.bestLane)).store(block_.bestLane);
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    RayBlock block_;
    Floats zCut_;
    unsigned endless_ = 0, hidden_ = 0; // rays that start where they start, and hidden ones
    bool areTrianglesSetUp_ = false;
    std::uint32_t metCount_ = 0;
    Best best_;          // of what met_ has
    Met met_[kMost + 1]; // the last one is written by those who have none
    RayTriangle pairs_[kMost * W];
};

LANES_END
