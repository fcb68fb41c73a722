// The kernel for rays from one point: tracing a bundle of them is rasterising a tile, with the tree
// as its hierarchy of what is hidden. Boxes are tested against the rectangle of the bundle, W at a
// time, and a ray is touched only by triangles that overlap its packet. Both culls are exact:
// boxes: if one is beside the rectangle, the monotone rounding of x - S z gives all vertices in it
// the same strict sign, and ShearedTriangle::containsRay() is false; depth: a key is at most 1/zMin
// of its triangle, so a box behind zCut holds no better one.
#pragma once

#include "accel/kernels/beam.h"
#include "accel/kernels/bundle_leaf.h"
#include "accel/kernels/bundle_rays.h"
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/pause.h"
#include "accel/kernels/queue.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/stack.h"
#include "accel/kernels/wide_tree.h"
#include "base/cpu.h"
#include "base/ray.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

LANES_BEGIN

template <Query Q> class Bundle {
public:
    using Range = typename BundleRays<Q>::Range;

    Bundle(const WideMesh& mesh, const RaySpan& rays, Vec3 origin)
        : mesh_(mesh), rays_(mesh, rays, origin), leaf_(mesh, rays_) {
        const std::size_t stride = strideOfStacks(mesh.tree.stackSize);
        refs_ = reinterpret_cast<WideRef*>(scratchMemory(2 * stride * sizeof(WideRef)));
        entries_ = refs_ + stride;
    }

    // Answers the rays of the list. Those that are rays from one point to places all over the
    // scene, and no bundle, are given back: the queue is faster for them.
    template <class Results>
    void trace(std::span<const std::uint32_t> list, const Results& results,
               std::vector<std::uint32_t>& givenBack) {
        leaves_ = 0;
        mostLeaves_ = list.size() + list.size() / 4 + 16;
        mostWork_ = kWorthwhile * mesh_.tree.leavesPerRay * static_cast<float>(list.size());
        rays_.load(list);
        rays_.refuse(results);
        while (rays_.nextRound()) {
            const float noLimit = std::numeric_limits<float>::max();
            const auto& root = mesh_.tree.at<WideNode<W>>(mesh_.tree.root);
            if (bits(enteredChildren(root, noLimit).any) == 0) {
                rays_.writeMisses(results);
                continue;
            }
            rays_.setUp();
            leaf_.start();
            if (traverse())
                leaf_.finish(results);
            else
                rays_.giveBack(givenBack);
        }
    }

    std::size_t leaves() const { return leaves_; } // of the last list

private:
    // False: given up.
    bool traverse() {
        size_ = 0;
        WideRef at = mesh_.tree.root;
        while (leaf_.zCut() >= 0) {
            if (kindOf(at) == WideKind::Node) {
                if (enter(at)) continue;
            } else {
                if (leaves_ > mostLeaves_ && work() > mostWork_) return false;
                ++leaves_;
                leaf_.test(at);
            }
            if (!pop(at)) return true;
        }
        return true;
    }

    // Goes to the nearest child that the bundle enters, the others go onto the stack; false: there
    // is none.
    bool enter(WideRef& at) {
        const auto& node = mesh_.tree.at<WideNode<W>>(at);
        const Children hit = enteredChildren(node, leaf_.zCut());
        const int count = std::popcount(bits(hit.any));
        if (count == 0) return false;
        WideRef* const refs = refs_ + size_;
        at = pushSorted(hit.any, count, hit.entry, node.child, refs, entries_ + size_);
        for (int i = 0; i < count; ++i) prefetch(refs[i]);
        size_ += static_cast<std::uint32_t>(count) - 1;
        return true;
    }

    // Takes the nearest of what no hit hides, or anything when all rays are done; false: there is
    // none.
    bool pop(WideRef& at) {
        // The lowest four bits of an entry don't count.
        const std::uint32_t limit = std::bit_cast<std::uint32_t>(leaf_.zCut()) | 15;
        while (size_ != 0)
            if (entries_[--size_] <= limit) {
                at = refs_[size_];
                return true;
            }
        return false;
    }

    void prefetch(WideRef ref) const {
        const std::byte* const line = mesh_.tree.base() + byteOffset(ref);
        const int lines = kindOf(ref) == WideKind::Node ? kNodeLines : kLeafLines;
        for (int i = 0; i < lines; ++i) __builtin_prefetch(line + std::ptrdiff_t{64} * i);
    }

    // Children that the rectangle's pyramid enters in front of zCut, and their depths.
    struct Children {
        Mask any;
        Floats entry;
    };
    Children enteredChildren(const WideNode<W>& node, float zCut) const {
        const Floats s(rays_.sign), zero(0.0f), oz(rays_.origin[rays_.k]);
        const bool backwards = rays_.sign < 0;
        const Floats zNear = (Floats::load(node.plane[rays_.k][backwards ? 1 : 0]) - oz) * s;
        const Floats zFar = (Floats::load(node.plane[rays_.k][backwards ? 0 : 1]) - oz) * s;
        const Floats entry = max(zNear, zero);
        const Mask ahead = (zFar > zero) & (zNear <= Floats(zCut));
        // Of S z with S in the range and z in the box, the extremes are at corners.
        if (bits(ahead & (zNear < zero)) != 0) [[unlikely]] {
            const auto meets = [&](std::size_t axis, Range S) {
                const Floats o(rays_.origin[axis]), lo(S.lo), hi(S.hi);
                const Floats a = lo * zNear, b = lo * zFar, c = hi * zNear, d = hi * zFar;
                return ((Floats::load(node.plane[axis][0]) - o) <= max(max(a, b), max(c, d))) &
                       ((Floats::load(node.plane[axis][1]) - o) >= min(min(a, b), min(c, d)));
            };
            return {ahead & meets(rays_.kx, rays_.x) & meets(rays_.ky, rays_.y), entry};
        }
        const auto meets = [&](std::size_t axis, Range S) {
            const Floats o(rays_.origin[axis]), lo(S.lo), hi(S.hi);
            return ((Floats::load(node.plane[axis][0]) - o) <= hi * (S.hi > 0 ? zFar : zNear)) &
                   ((Floats::load(node.plane[axis][1]) - o) >= lo * (S.lo > 0 ? zNear : zFar));
        };
        return {ahead & meets(rays_.kx, rays_.x) & meets(rays_.ky, rays_.y), entry};
    }

    // A bundle may look at more leaves than it has rays where each of them alone would look at
    // many. In the time of a bundle's leaf it tests two pairs, and a ray alone meets two leaves, of
    // which things hide about half.
    static constexpr float kWorthwhile = 0.25f;
    float work() const {
        return static_cast<float>(leaves_) + 0.5f * static_cast<float>(leaf_.pairs());
    }

    static constexpr int kNodeLines = sizeof(WideNode<W>) / 64;
    static constexpr int kLeafLines = sizeof(WideLeaf<W>) / 64;

    const WideMesh& mesh_;
    BundleRays<Q> rays_;
    BundleLeaf<Q> leaf_;
    WideRef* refs_; // the stack of stack.h
    std::uint32_t* entries_;
    std::uint32_t size_ = 0;
    std::size_t leaves_ = 0, mostLeaves_ = 0;
    float mostWork_ = 0;
};

// How many rays make a bundle: large bundles of fine triangles touch too many of them, and in a
// thicket no bundle pays. It follows what the thread's last bundles met; no answer depends on it.
template <Query Q> class BundleSize {
public:
    std::size_t get() const { return size_; }
    // Are the next get() rays better left to the queue?
    bool passes() { return pause_.passes(); }
    // `leavesPerRay`: of the tree. Where rays meet many leaves anyway, neighbours meet the same.
    void learn(std::size_t leaves, float leavesPerRay, bool gaveUp) {
        const float many = ::max(kManyLeaves, kManyTimes * leavesPerRay);
        if (static_cast<float>(leaves) > many) size_ = kFewRays;
        if (leaves > 0 && leaves < kFewLeaves) size_ = BundleRays<Q>::kMostRays;
        pause_.learn(!gaveUp);
    }

private:
    static constexpr std::size_t kFewRays = 64, kFewLeaves = 6;
    static constexpr float kManyLeaves = 40, kManyTimes = 15;
    std::size_t size_ = BundleRays<Q>::kMostRays;
    Pause pause_{31}; // in bundles
};

template <Query Q, class Results>
void traceFromPoint(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
                    const Results& results) {
    thread_local BundleSize<Q> size;
    Bundle<Q> bundle(mesh, rays, rays.org[order[0]]);
    std::vector<std::uint32_t> givenBack;
    if (mesh.tree.lines.size() > mesh.mostLinesForBundles) {
        givenBack.assign(order.begin(), order.end());
        order = {};
    }
    while (!order.empty()) {
        const auto list = order.first(std::min(size.get(), order.size()));
        order = order.subspan(list.size());
        if (size.passes()) {
            givenBack.insert(givenBack.end(), list.begin(), list.end());
            continue;
        }
        const std::size_t before = givenBack.size();
        bundle.trace(list, results, givenBack);
        size.learn(bundle.leaves(), mesh.tree.leavesPerRay,
                   givenBack.size() - before > list.size() / 2);
    }
    if (givenBack.empty()) return;
    if constexpr (Q == Query::Any) // beams of them wouldn't pay either
        traceOneByOne<Q>(mesh, rays, givenBack, results);
    else
        closest(mesh, rays, givenBack, results);
}

void closestFromPoint(const WideMesh& mesh, const RaySpan& rays,
                      std::span<const std::uint32_t> order, const HitLists& hits) {
    traceFromPoint<Query::Closest>(mesh, rays, order, hits);
}
void anyFromPoint(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
                  std::uint8_t* hidden) {
    traceFromPoint<Query::Any>(mesh, rays, order, hidden);
}

LANES_END
