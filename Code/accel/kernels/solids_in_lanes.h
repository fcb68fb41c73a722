// Packets of W rays that walk the tree of the solids together, each child with the rays that enter
// it. Rays into one octant (most camera rays, shadow rays of a lamp) see a node as one interval of
// rays that looks at W children at once; of rays that go apart each looks at them for itself, as in
// queue.h, but the node is fetched once and the steps overlap, and their solids wait in pairs.
// What decides is exact: entries into a solid's own box as RaySetup::enters() rounds them,
// spheres as AnalyticShape and Sphere compute them, operation by operation in double. Everything
// before that only leaves out: the boxes' pads are 64 roundings of the coordinates wide, and what a
// ray meets lies inside of the box without the pad.
#pragma once

#include "accel/kernels/chord.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_answers.h"
#include "accel/kernels/solids_cubes.h"
#include "accel/kernels/solids_each.h"
#include "accel/kernels/solids_facets.h"
#include "accel/kernels/solids_flats.h"
#include "accel/kernels/solids_hulls.h"
#include "accel/kernels/solids_meet.h"
#include "accel/kernels/solids_objects.h"
#include "accel/kernels/solids_pairs.h"
#include "accel/kernels/solids_rays.h"
#include "accel/kernels/solids_spheres.h"
#include "accel/kernels/solids_tubes.h"
#include "accel/kernels/solids_turning.h"
#include "accel/kernels/wide_tree.h"
#include "base/cpu.h"
#include "base/math.h"
#include "base/ray.h"
#include "simd/double_double_lanes.h"
#include "simd/lanes.h"
#include "simd/sine_lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

class SolidPackets : PacketPairs {
public:
    SolidPackets(const SolidTree& tree, const SolidCalls& calls, const RaySpan& rays)
        : PacketPairs(tree, calls, rays) {}

    template <Answer A, class Result>
    void run(std::span<const std::uint32_t> order, Result* results) {
        for (; !order.empty(); order = order.subspan(std::min<std::size_t>(W, order.size()))) {
            live_ = setUp<A>(order, results);
            if (live_ == 0) continue;
            if (A == Answer::Any && lastHider_ < tree_.solids.size())
                solid<A>(lastHider_, live_, results);
            meetEndless<A>(results);
            if (live_ == 0 || tree_.lines.empty()) continue;
            traverse<A>(results);
            if (!areInPairs_) continue;
            if (live_ != 0) meetAll<A>(results);
            dropAll();
        }
    }

private:
    // A node that is entered later, with the lanes that do, and at which depth the first one does.
    struct Entry {
        float z;
        WideRef ref;
        unsigned lanes;
    };

    template <Answer A, class Result> void traverse(Result* results) {
        std::array<Entry, (kMaxTreeDepth + 1) * W> stack;
        std::size_t size = 0;
        WideRef at = wideRef(0, WideKind::Node);
        unsigned lanes = live_;
        for (;;) {
            if (SolidTree::isLeaf(at)) {
                solid<A>(at >> 2, lanes, results);
            } else if (together_ && std::popcount(lanes) >= kFewestForInterval) {
                size = stepTogether<A>(tree_.node<W>(at), lanes, stack.data(), size, results);
            } else {
                size = stepApart<A>(tree_.node<W>(at), lanes, stack.data(), size, results);
                if (waiting_.count >= W) meetFull<A>(results);
            }
            if (A == Answer::Any && live_ == 0) return;
            do {
                if (size == 0) return;
                --size;
                lanes = stack[size].lanes & live_;
                if constexpr (A == Answer::Closest)
                    if (stack[size].z > zTop_) lanes = 0;
            } while (lanes == 0);
            at = stack[size].ref;
        }
    }

    template <Answer A>
    std::size_t push(Entry* stack, std::size_t bottom, std::size_t size, Entry entry) const {
        std::size_t place = size;
        if constexpr (A == Answer::Closest) // the nearest on top
            for (; place > bottom && stack[place - 1].z < entry.z; --place)
                stack[place] = stack[place - 1];
        stack[place] = entry;
        return size + 1;
    }

    // Over all r of the interval, a child is entered not before `entry` and left not after `exit`.
    template <Answer A, class Result>
    std::size_t stepTogether(const WideNode<W>& node, unsigned lanes, Entry* stack,
                             std::size_t size, Result* results) {
        Floats entry(0.0f), exit(zTop_);
        for (int axis = 0; axis < 3; ++axis) {
            const Floats lo(rLo_[axis]), hi(rHi_[axis]), pad(mostPad_[axis]);
            const std::size_t back = back_[axis];
            const Floats first(back ? oLo_[axis] : oHi_[axis]),
                last(back ? oHi_[axis] : oLo_[axis]);
            const Floats front = Floats::load(node.plane[axis][back]) - first;
            const Floats behind = Floats::load(node.plane[axis][1 - back]) - last;
            entry = max(min(front * lo, front * hi) - pad, entry);
            exit = min(max(behind * lo, behind * hi) + pad, exit);
        }
        alignas(64) float z[W];
        entry.store(z);
        const std::size_t bottom = size;
        for (unsigned hit = bits(entry <= exit); hit != 0; hit &= hit - 1) {
            const int i = std::countr_zero(hit);
            const WideRef ref = node.child[i];
            unsigned inside = lanes;
            if (A == Answer::Any && SolidTree::isLeaf(ref)) {
                solid<A>(ref >> 2, inside, results);
                lanes &= live_;
                if (lanes == 0) return size;
                continue;
            }
            if (kindOf(ref) == WideKind::Node) {
                Floats from(0.0f), to = zCut_;
                for (int axis = 0; axis < 3; ++axis) {
                    const std::size_t back = back_[axis];
                    from = max(fma(Floats(node.plane[axis][back][i]), lanes_.r[axis],
                                   lanes_.nearOffset[axis]),
                               from);
                    to = min(fma(Floats(node.plane[axis][1 - back][i]), lanes_.r[axis],
                                 lanes_.farOffset[axis]),
                             to);
                }
                inside &= bits(from <= to);
                if (inside == 0) continue;
            }
            size = push<A>(stack, bottom, size, {z[i], ref, inside});
        }
        return size;
    }

    // The children of a node that a ray enters.
    [[gnu::always_inline]] Mask enteredBy(const std::byte* planes, int ray, Floats& entry) const {
        Floats exit(rays1_.zCut[ray]);
        entry = Floats(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t nearPlane = rays1_.nearPlane[axis][ray],
                              farPlane = nearPlane ^ kPlane;
            const Floats r(rays1_.r[axis][ray]);
            entry =
                max(fma(Floats::load(planes + nearPlane), r, Floats(rays1_.nearOffset[axis][ray])),
                    entry);
            exit = min(fma(Floats::load(planes + farPlane), r, Floats(rays1_.farOffset[axis][ray])),
                       exit);
        }
        return entry <= exit;
    }

    // Solids wait for rays of others, or are met at once.
    template <Answer A, class Result>
    std::size_t stepApart(const WideNode<W>& node, unsigned lanes, Entry* stack, std::size_t size,
                          Result* results) {
        const auto* const planes = reinterpret_cast<const std::byte*>(&node);
        static_assert(static_cast<int>(WideKind::Leaf) == 1 &&
                      static_cast<int>(WideKind::None) == 2 &&
                      static_cast<int>(SolidTree::kInOrder) == 3);
        const unsigned bit0 = kindBits<0>(node), bit1 = kindBits<1>(node), leaves = bit0 & ~bit1;
        const unsigned inPairs = areInPairs_ ? leaves : 0;
        const Mask pairMask = maskOf(inPairs);
        std::uint32_t waiting = waiting_.count;
        LaneColumns entered; // rows are rays, columns children
        unsigned any = 0;
        Floats nearest(kInfinityF);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int ray = std::countr_zero(lanes);
            Floats entry;
            const Mask isHit = enteredBy(planes, ray, entry);
            if constexpr (A == Answer::Closest) nearest = minWhere(isHit, nearest, entry);
            const unsigned hit = bits(isHit);
            if (inPairs != 0) waiting = wait(ray, isHit & pairMask, node.child, waiting);
            entered.set(ray, isHit);
            any |= hit;
        }
        waiting_.count = waiting;
        any &= ~inPairs;
        alignas(64) std::uint32_t entering[W];
        entered.store(entering);
        alignas(64) float z[W];
        if constexpr (A == Answer::Closest) nearest.store(z);
        const std::size_t bottom = size;
        for (; any != 0; any &= any - 1) {
            const int i = std::countr_zero(any);
            if ((leaves >> i & 1) != 0) {
                if (const unsigned asking = entering[i] & live_; asking != 0)
                    solid<A>(node.child[i] >> 2, asking, results);
                continue;
            }
            const float from = A == Answer::Closest ? z[i] : 0;
            if (kindOf(node.child[i]) == WideKind::Node) ::prefetch(tree_.node<W>(node.child[i]));
            size = push<A>(stack, bottom, size, {from, node.child[i], entering[i]});
        }
        return size;
    }
};

void closestSolids(const SolidTree& tree, const SolidCalls& calls, const RaySpan& rays,
                   std::span<const std::uint32_t> order, Hit* hits) {
    SolidPackets(tree, calls, rays).run<Answer::Closest>(order, hits);
}
void anySolids(const SolidTree& tree, const SolidCalls& calls, const RaySpan& rays,
               std::span<const std::uint32_t> order, std::uint8_t* hidden) {
    SolidPackets(tree, calls, rays).run<Answer::Any>(order, hidden);
}

LANES_END
