// The kernel for rays that start close together and go nearly the same way: those that a pixel's
// samples send to a lamp, say. W of them are a beam, which asks once for all which nodes and
// triangles they may meet; those triangles are asked of W rays at once.
#pragma once

#include "accel/kernels/beam_shape.h"
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/handful.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/lane_hits.h"
#include "accel/kernels/pause.h"
#include "accel/kernels/queue.h"
#include "accel/kernels/queue_exact.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/stack.h"
#include "accel/kernels/wide_tree.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

LANES_BEGIN

template <Query Q> class Beam {
public:
    Beam(const WideMesh& mesh, const RaySpan& rays)
        : mesh_(mesh), mostWork_(W * mostWorkPerRay(mesh.tree)), hits_(mesh, rays) {
        const std::size_t stride = strideOfStacks(mesh.tree.stackSize);
        refs_ = reinterpret_cast<WideRef*>(scratchMemory(2 * stride * sizeof(WideRef)));
        entries_ = refs_ + stride;
    }

    // Answers the rays. Those that are no beam are given back.
    template <class Results>
    void trace(std::span<const std::uint32_t, W> order, const Results& results,
               std::vector<std::uint32_t>& givenBack) {
        const RayColumns columns = hits_.load(order.data(), W);
        const RayAxes axes(columns);
        hits_.start(columns, axes, W);
        unsigned left = axes.traceable;
        work_ = mostWork_;
        if (left != 0 && shape_.set(columns, axes, left, hits_.zCut(), mesh_.extent) &&
            traverse(columns, axes)) {
            left &= ~shape_.rays;
            hits_.finish(columns, axes, results);
        } else {
            hits_.write(results);
        }
        for (; left != 0; left &= left - 1) givenBack.push_back(hits_.ray(std::countr_zero(left)));
    }

    // Was the last one cheap enough?
    bool pays() const { return work_ < 0.5f * mostWork_; }

private:
    // Nodes, leaves and triangles that a beam may ask for, in steps that take about as long as one
    // of a ray by itself. That ray ends at the first hit, or looks for a better one in all leaves.
    static float mostWorkPerRay(const WideTree& tree) {
        return Q == Query::Any ? 10 : 1.5f * (3 + tree.leavesPerRay);
    }

    // False: given up.
    bool traverse(const RayColumns& columns, const RayAxes& axes) {
        size_ = 0;
        work_ = 0;
        WideRef at = mesh_.tree.root;
        for (;;) {
            work_ += 1;
            if (work_ > mostWork_) return false;
            if (kindOf(at) == WideKind::Node) {
                if (enter(at)) continue;
            } else {
                const auto& leaf = mesh_.tree.at<WideLeaf<W>>(at);
                if (const unsigned near = shape_.near(leaf); near != 0) {
                    work_ += static_cast<float>(std::popcount(near));
                    test(columns, axes, at, leaf, near);
                    if (Q == Query::Any && (shape_.rays & ~hits_.hidden()) == 0) return true;
                }
            }
            if (!pop(at)) return true;
        }
    }

    // Goes to a child that rays may enter, the nearest if that matters; the others go onto the
    // stack. False: there is none.
    bool enter(WideRef& at) {
        const auto& node = mesh_.tree.at<WideNode<W>>(at);
        const BeamShape::Children in = shape_.entered(node);
        const unsigned lanes = bits(in.any);
        const int count = std::popcount(lanes);
        if (count == 0) return false;
        at = Q == Query::Any
                 ? pushAny(in.any, lanes, node.child, refs_ + size_)
                 : pushSorted(in.any, count, in.entry, node.child, refs_ + size_, entries_ + size_);
        size_ += static_cast<std::uint32_t>(count) - 1;
        return true;
    }

    // Takes the next one that no hit hides; false: there is none.
    bool pop(WideRef& at) {
        // The lowest four bits of an entry don't count.
        const std::uint32_t limit = std::bit_cast<std::uint32_t>(shape_.end()) | 15;
        while (size_ != 0) {
            --size_;
            if (Q == Query::Closest && entries_[size_] > limit) continue;
            at = refs_[size_];
            return true;
        }
        return false;
    }

    void test(const RayColumns& columns, const RayAxes& axes, WideRef ref, const WideLeaf<W>& leaf,
              unsigned near) {
        const Floats ox = columns.org[shape_.kx], oy = columns.org[shape_.ky],
                     oz = columns.org[shape_.k];
        const Floats shearX = axes.Sx * axes.sign, shearY = axes.Sy * axes.sign;
        for (; near != 0; near &= near - 1) {
            const auto j = static_cast<std::uint32_t>(std::countr_zero(near));
            Sheared s;
            for (int c = 0; c < 3; ++c) {
                const std::size_t i = leaf.corner[c][j];
                s.z[c] = Floats(leaf.point[shape_.k][i]) - oz;
                s.x[c] = (Floats(leaf.point[shape_.kx][i]) - ox) - shearX * s.z[c];
                s.y[c] = (Floats(leaf.point[shape_.ky][i]) - oy) - shearY * s.z[c];
            }
            const Edges edges(s);
            const unsigned lanes = shape_.rays & ~hits_.hidden();
            if ((bits(edges.around()) & lanes) == 0) continue;
            hits_.ask(columns, axes, s, edges, ref, j, lanes);
        }
        if constexpr (Q == Query::Closest) shape_.endAt(hits_.zCut());
    }

    const WideMesh& mesh_;
    WideRef* refs_; // the stack of stack.h
    std::uint32_t* entries_;
    std::uint32_t size_ = 0;
    float work_ = 0, mostWork_;
    BeamShape shape_;
    LaneHits<Q> hits_;
};

// Answers rays that are beams, and returns the others. What does not pay is left for longer and
// longer, but every batch gets a chance.
template <Query Q, class Results>
std::span<const std::uint32_t> traceBeams(const WideMesh& mesh, const RaySpan& rays,
                                          std::span<const std::uint32_t> order,
                                          const Results& results) {
    thread_local Pause pause(1023); // in beams
    thread_local std::vector<std::uint32_t> others;
    if (order.size() < W) return order;
    others.clear();
    pause.end();
    Beam<Q> beam(mesh, rays);
    std::size_t next = 0;
    for (; order.size() - next >= W; next += W) {
        if (pause.passes((order.size() - next) / W)) {
            if (others.size() == next) return order;
            break;
        }
        const auto some = order.subspan(next).template first<W>();
        if (pause.passes()) {
            others.insert(others.end(), some.begin(), some.end());
            continue;
        }
        beam.trace(some, results, others);
        pause.learn(beam.pays());
    }
    others.insert(others.end(), order.begin() + static_cast<std::ptrdiff_t>(next), order.end());
    return others;
}

template <Query Q, class Results>
void traceAll(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
              const Results& results) {
    if (!Handful<Q>::holds(mesh)) order = traceBeams<Q>(mesh, rays, order, results);
    if (!order.empty()) traceOneByOne<Q>(mesh, rays, order, results);
}

void closest(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
             const HitLists& hits) {
    traceAll<Query::Closest>(mesh, rays, order, hits);
}
void any(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
         std::uint8_t* hidden) {
    traceAll<Query::Any>(mesh, rays, order, hidden);
}

LANES_END
