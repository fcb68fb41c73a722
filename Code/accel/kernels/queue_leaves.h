// What rays of the queue do at leaves. A nearest hit that is certain in float is taken at once, and
// its canonical key is computed when W rays are done; where bounds overlap, rays wait until there
// are enough of them for the keys of W pairs at once.
#pragma once

#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_exact.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/queue_slots.h"
#include "accel/kernels/ray_lists.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

template <Query Q> class QueueLeaves {
protected:
    // `used`: slots that will ever have a ray.
    QueueLeaves(const WideMesh& mesh, const RaySpan& rays, std::size_t used)
        : mesh_(mesh), rays_(rays), slots_(mesh.tree, used) {}

    // A step of the rays at leaves.
    void takeLeaves() {
        const std::uint32_t count = lists_.leaves.size();
        Found found;
        if (meetings_ == Meetings::Many)
            found = leafSteps<Meetings::Many>();
        else if (meetings_ == Meetings::Few)
            found = leafSteps<Meetings::Few>();
        else
            found = leafSteps<Meetings::Some>();
        meetings_ = found.met * 3 > count                ? Meetings::Many
                    : (count - found.beside) * 8 < count ? Meetings::Few
                                                         : Meetings::Some;
        if constexpr (Q == Query::Closest) acceptMet(found);
    }

    // Computes the keys that rays wait for, if there are enough of them or `now`.
    void settleIfWorth(bool now) {
        if (waitingPairs_ < W && !now) return;
        std::uint32_t n = 0;
        for (const auto& [slot, leaf, candidates] : std::span(waiting_, waitingCount_)) {
            if constexpr (Q == Query::Closest) reopen(slot, n);
            for (unsigned left = candidates; left != 0; left &= left - 1)
                pairs_[n++] = {numberOf(slot), leaf,
                               static_cast<std::uint32_t>(std::countr_zero(left))};
        }
        takePairs(n);
        for (const Waiting& w : std::span(waiting_, waitingCount_))
            lists_.send(w.slot, slots_.pop(slots_.ray(w.slot)));
        waitingCount_ = waitingPairs_ = 0;
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    QueueSlots slots_;
    RayLists<QueueSlots::kSlots> lists_;

private:
    static constexpr std::uint32_t kSlots = QueueSlots::kSlots;

    // How many rays meet triangles of their leaves: branches are guessed right where nearly all do
    // the same, and cost more than what they spare elsewhere.
    enum class Meetings { Many, Some, Few };

    struct Waiting {
        Slot slot;
        WideRef leaf;
        std::uint32_t candidates; // triangles of the leaf that the ray is at
    };

    // Triangles of the leaf that a ray is at, and what Judged says of their depths.
    struct alignas(64) Met {
        float depth[W], noise[W], det[W];
        Slot slot;
        WideRef leaf;
        std::uint32_t candidates, certain; // certain: to be hits
    };

    // What the leaves of a round had.
    struct Found {
        std::uint32_t met = 0, passed = 0, beside = 0;
    };

    // ---- steps

    template <Meetings M> [[gnu::noinline]] Found leafSteps() {
        Found found;
        std::uint32_t went = lists_.went.size(); // in a register
        for (std::uint32_t i = 0; i < lists_.leaves.size(); ++i) {
            const Slot slot = lists_.leaves.slot(i);
            const QueueRay ray = slots_.ray(slot);
            if (leafStep<M>(slot, lists_.leaves.ref(i), ray, found))
                lists_.went.set(went++, slot, slots_.pop(ray));
        }
        lists_.went.resize(went);
        return found;
    }

    // Returns whether the ray goes on at once.
    template <Meetings M>
    [[gnu::always_inline]] bool leafStep(Slot slot, WideRef at, const QueueRay& ray, Found& found) {
        const WideLeaf<W>& leaf = slots_.leafAt(at);
        const Sheared corners = sheared(ray, leaf);
        const Edges edges(corners);
        const unsigned all = (1u << leaf.count) - 1;
        if constexpr (M != Meetings::Many) {
            const bool isBeside = (bits(edges.around()) & all) == 0; // all triangles
            found.beside += isBeside;
            if (M == Meetings::Few && isBeside) [[likely]]
                return true;
        }
        const Judged judged = judge(corners, edges, Floats(ray.at(&RayBlock::sign)));
        const Floats zCut(ray.at(&RayBlock::zCut));
        const unsigned candidates = judged.candidates(zCut) & all;
        if (M != Meetings::Many && candidates == 0) [[likely]]
            return true;
        if constexpr (Q == Query::Any) {
            const bool isHidden =
                (judged.certain(zCut) & all) != 0 && ray.at(&RayBlock::below) == kInfinityF;
            found.met += isHidden;
            if (candidates == 0 || isHidden) [[likely]] {
                std::uint32_t &triangle = ray.at(&RayBlock::triangle),
                              &top = ray.at(&RayBlock::stackTop);
                triangle = isHidden ? 0 : triangle;
                top = isHidden ? ray.at(&RayBlock::bottom) + 1 : top;
                return true;
            }
            wait(slot, at, candidates);
        } else {
            passed_[found.passed] = slot;
            found.passed += candidates == 0;
            Met& met = met_[found.met];
            found.met += candidates != 0;
            met.slot = slot, met.leaf = at, met.candidates = candidates;
            met.certain = bits(judged.certain()) & candidates;
            judged.depth.store(met.depth), judged.noise.store(met.noise);
            judged.det.store(met.det);
        }
        return false;
    }

    void wait(Slot slot, WideRef leaf, std::uint32_t candidates) {
        waiting_[waitingCount_++] = {slot, leaf, candidates};
        waitingPairs_ += static_cast<std::uint32_t>(std::popcount(candidates));
    }

    // Takes for each ray the candidate that is nearest, if that is certain without keys; the key of
    // what remains the best one is computed at the end. Apart from run(), as nodeSteps() is.
    [[gnu::noinline]] void acceptMet(const Found& found) {
        for (const Slot slot : std::span(passed_, found.passed))
            lists_.went.add(slot, slots_.pop(slots_.ray(slot)));
        for (const Met& met : std::span(met_, found.met)) {
            const QueueRay ray = slots_.ray(met.slot);
            if (accept(met, ray))
                lists_.went.add(met.slot, slots_.pop(ray));
            else
                wait(met.slot, met.leaf, met.candidates);
        }
    }

    // The candidate that is nearest for certain: its depth is between these.
    struct Best {
        std::uint32_t lane = 0;
        float nearest = kInfinityF, farthest = kInfinityF; // none
    };

    [[gnu::always_inline]] bool accept(const Met& met, const QueueRay& ray) {
        const Best found = std::has_single_bit(met.candidates) ? onlyOne(met) : nearestOf(met);
        float& best = ray.at(&RayBlock::depth);
        if (!(found.farthest < best) || ray.at(&RayBlock::below) != kInfinityF) [[unlikely]]
            return false;
        ray.at(&RayBlock::bestLane) = found.lane;
        ray.at(&RayBlock::bestLeaf) = met.leaf;
        best = found.nearest;
        float& zCut = ray.at(&RayBlock::zCut);
        zCut = ::min(found.farthest, zCut);
        slots_.block(QueueSlots::blockOf(met.slot)).open |= 1u << QueueSlots::laneOf(met.slot);
        slots_.dropBehind(ray);
        return true;
    }
    // As most have it in scenes of few and large triangles: without a division of W.
    [[gnu::always_inline]] static Best onlyOne(const Met& met) {
        if (met.certain == 0) [[unlikely]]
            return {};
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(met.candidates));
        const float depth = met.depth[lane], noise = met.noise[lane], inverse = 1 / met.det[lane];
        return {lane, nearestDepth(depth, noise, inverse), farthestDepth(depth, noise, inverse)};
    }
    [[gnu::always_inline]] static Best nearestOf(const Met& met) {
        const Floats depth = Floats::load(met.depth), noise = Floats::load(met.noise),
                     inverse = Floats(1.0f) / Floats::load(met.det);
        const Floats nearest = nearestDepth(depth, noise, inverse),
                     farthest = farthestDepth(depth, noise, inverse);
        alignas(64) float each[W];
        nearest.store(each);
        const float least = smallest(select(maskOf(met.certain), farthest, Floats(kInfinityF)));
        const unsigned rivals = bits(notGreater(nearest, Floats(least))) & met.candidates;
        if (!std::has_single_bit(rivals) || (rivals & met.certain) == 0) [[unlikely]]
            return {};
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(rivals));
        return {lane, each[lane], least};
    }

    // ShearedTriangle of accel/triangle.h for the triangles of a leaf: they share their points.
    [[gnu::always_inline]] static Sheared sheared(const QueueRay& ray, const WideLeaf<W>& leaf) {
        const std::byte* const p = reinterpret_cast<const std::byte*>(&leaf);
        const auto relative = [&](std::size_t axis) {
            return Floats::load(p + ray.at(&RayBlock::axis, axis)) -
                   Floats(ray.at(&RayBlock::origin, axis));
        };
        const Floats x = relative(0), y = relative(1), z = relative(2);
        const Floats xs = x - Floats(ray.at(&RayBlock::shearX)) * z,
                     ys = y - Floats(ray.at(&RayBlock::shearY)) * z;
        Sheared s;
        for (int c = 0; c < 3; ++c) {
            const Ints at = Ints::bytes(leaf.corner[c]);
            s.x[c] = permute(xs, at), s.y[c] = permute(ys, at), s.z[c] = permute(z, at);
        }
        return s;
    }

    // ---- canonical keys

    // A hit without a key that others come near needs one, too.
    void reopen(Slot slot, std::uint32_t& n) {
        RayBlock& b = slots_.block(QueueSlots::blockOf(slot));
        const std::uint32_t i = QueueSlots::laneOf(slot);
        if ((b.open >> i & 1) == 0) return;
        b.open &= ~(1u << i);
        pairs_[n++] = {numberOf(slot), b.bestLeaf[i], b.bestLane[i]};
    }

    // As pairs have it.
    static std::uint32_t numberOf(Slot slot) {
        return QueueSlots::blockOf(slot) * W + QueueSlots::laneOf(slot);
    }

    void takePairs(std::uint32_t n) {
        settlePairs<Q>(mesh_, rays_, slots_.blocks(), {pairs_, n}, [this](std::uint32_t number) {
            const QueueRay ray = slots_.ray(QueueSlots::slotOf(number / W, number % W));
            if constexpr (Q == Query::Any)
                QueueSlots::leaveOnlyEnd(ray);
            else
                slots_.dropBehind(ray);
        });
    }

    Waiting waiting_[kSlots];
    Met met_[kSlots + 1];
    Slot passed_[kSlots + 1];            // rays that met nothing in their leaves
    Meetings meetings_ = Meetings::Some; // in the last round
    std::uint32_t waitingCount_ = 0, waitingPairs_ = 0;
    RayTriangle pairs_[kSlots * (W + 1)];
};

LANES_END
