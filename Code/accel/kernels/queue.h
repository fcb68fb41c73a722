// The kernel for rays of any kind. Many rays are on their way at once, each at its next node or
// leaf; two lists say which (ray_lists.h). A round takes one step with every ray of a list: the
// steps don't depend on each other, so the CPU overlaps their memory accesses and latencies, and
// nothing but the length of the lists is a branch.
#pragma once

#include "accel/kernels/handful.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_answers.h"
#include "accel/kernels/queue_exact.h"
#include "accel/kernels/queue_leaves.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/queue_slots.h"
#include "accel/kernels/root_boxes.h"
#include "accel/kernels/stack.h"
#include "accel/kernels/wide_tree.h"
#include "base/cpu.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

template <Query Q> class Queue : QueueLeaves<Q> {
    using QueueLeaves<Q>::mesh_, QueueLeaves<Q>::rays_, QueueLeaves<Q>::slots_,
        QueueLeaves<Q>::lists_;

public:
    Queue(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order)
        : QueueLeaves<Q>(mesh, rays, order.size()), order_(order), root_(mesh.tree) {}

    template <class Results> void run(const Results& results) {
        for (std::uint32_t b = 0; b < QueueSlots::kBlocks; ++b) refill(b, results);
        while (live_ > 0) {
            nodeSteps();
            this->takeLeaves();
            lists_.sort();
            this->settleIfWorth(lists_.nodes.size() + lists_.leaves.size() < kFewBusy);
            for (std::uint32_t i = 0; i < lists_.done.size(); ++i) {
                const std::uint32_t number = QueueSlots::blockOf(lists_.done.slot(i));
                RayBlock& b = slots_.block(number);
                --live_;
                if (--b.live > 0) continue;
                if (b.open != 0) settleOpen(mesh_, rays_, b);
                writeAnswers(b, mesh_.tree, results);
                refill(number, results);
            }
        }
    }

private:
    // Rays that are not waiting for others; with fewer, the others don't wait either.
    static constexpr std::uint32_t kFewBusy = QueueSlots::kSlots / 3;

    // The next rays that enter the tree, if there are any left, take this block. Those that don't
    // are answered at once.
    template <class Results> void refill(std::uint32_t number, const Results& results) {
        RayBlock& b = slots_.block(number);
        while (next_ < order_.size()) {
            const unsigned entered = root_.entering(b, takeRays(b));
            if (entered == 0) {
                writeAnswers(b, mesh_.tree, results);
                continue;
            }
            slots_.start(number);
            b.live = static_cast<std::uint32_t>(std::popcount(entered));
            live_ += b.live;
            for (unsigned lanes = entered; lanes != 0; lanes &= lanes - 1)
                lists_.send(
                    QueueSlots::slotOf(number, static_cast<std::uint32_t>(std::countr_zero(lanes))),
                    mesh_.tree.root);
            return;
        }
    }

    unsigned takeRays(RayBlock& b) {
        const std::size_t count = std::min<std::size_t>(W, order_.size() - next_);
        const unsigned lanes = setUpRays<Q>(rays_, &order_[next_], count, mesh_.extent, b);
        next_ += count;
        return lanes;
    }

    // Apart from run(): its loop has all registers.
    [[gnu::noinline]] void nodeSteps() {
        const std::uint32_t count = lists_.nodes.size();
        for (std::uint32_t i = 0; i < count; ++i) {
            const Slot slot = lists_.nodes.slot(i);
            lists_.went.set(i, slot, nodeStep(lists_.nodes.ref(i), slots_.ray(slot)));
        }
        lists_.went.resize(count);
    }

    // RaySetup::enters() for W boxes. With FMA or without: the pads of the slabs are twice those of
    // the canonical hit, and the difference covers either rounding several times.
    [[gnu::always_inline]] WideRef nodeStep(WideRef at, const QueueRay& ray) const {
        const std::byte* const node = slots_.nodeAt(at);
        Floats entry(0.0f), exit(ray.at(&RayBlock::zCut));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t nearPlane = ray.at(&RayBlock::nearPlane, axis);
            const std::uint32_t farPlane = nearPlane ^ (W * 4);
            const Floats r(ray.at(&RayBlock::r, axis));
            entry = max(
                fma(Floats::load(node + nearPlane), r, Floats(ray.at(&RayBlock::nearOffset, axis))),
                entry);
            exit = min(
                fma(Floats::load(node + farPlane), r, Floats(ray.at(&RayBlock::farOffset, axis))),
                exit);
        }
        const Mask hit = entry <= exit;
        const unsigned lanes = bits(hit);
        const int hits = std::popcount(lanes);
        const auto* const child =
            reinterpret_cast<const WideRef*>(node + std::ptrdiff_t{6} * W * 4);
        std::uint32_t& top = ray.at(&RayBlock::stackTop);
        std::uint32_t* const refs = slots_.refs(top);
        // The next one is taken from registers: what was just stored takes long to come back.
        const WideRef nearest =
            Q == Query::Any ? pushAny(hit, lanes, child, refs)
                            : pushSorted(hit, hits, entry, child, refs, slots_.entries(top));
        // Without a child, what was on top before.
        const WideRef before = refs[-1];
        const WideRef next = hits != 0 ? nearest : before;
        top = top + static_cast<std::uint32_t>(hits) - 1;
        slots_.prefetch(next);
        return next;
    }

    std::span<const std::uint32_t> order_;
    RootQuestion root_;
    std::size_t next_ = 0;
    std::uint32_t live_ = 0;
};

template <Query Q, class Results>
void traceOneByOne(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
                   const Results& results) {
    if (Handful<Q>::holds(mesh))
        Handful<Q>(mesh, rays).run(order, results);
    else
        Queue<Q>(mesh, rays, order).run(results);
}

LANES_END
