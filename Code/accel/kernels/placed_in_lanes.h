// The queue of queue.h in two levels: rays walk the tree over the boxes of the meshes, and in
// between the tree of one mesh after the other, all of them at once. Lists say what each does next.
#pragma once

#include "accel/kernels/exact_hit.h"
#include "accel/kernels/placed.h"
#include "accel/kernels/placed_mesh.h"
#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/ray_lists.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/stack.h"
#include "accel/kernels/wide_tree.h"
#include "base/bounds.h"
#include "base/ray.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

LANES_BEGIN

template <bool NearFirst> class PlacedQueue {
public:
    PlacedQueue(const PlacedTree& tree, PlacedQuery& query, const RaySpan& rays,
                std::span<const std::uint32_t> order)
        : tree_(tree.boxes), whole_(tree.whole), query_(query), rays_(rays), order_(order),
          sceneStride_(strideOfStacks(tree.boxStack)), stride_(strideOfStacks(tree.meshStack)) {
        const std::size_t stacks = kSlots * (sceneStride_ + stride_);
        std::byte* const memory =
            scratchMemory(kSlots * sizeof(Slot) + 2 * stacks * sizeof(std::uint32_t));
        slots_ = reinterpret_cast<Slot*>(memory);
        auto* const words = reinterpret_cast<std::uint32_t*>(memory + kSlots * sizeof(Slot));
        inScene_ = {words, words + kSlots * sceneStride_};
        inMesh_ = {words + 2 * kSlots * sceneStride_,
                   words + 2 * kSlots * sceneStride_ + kSlots * stride_};
    }

    void run() {
        Lists now(lists_[0]), next(lists_[1]);
        for (std::uint32_t slot = 0; slot < kSlots; ++slot) start(slot, next);
        while (live_ > 0) {
            std::swap(now, next);
            next.clear();
            for (std::uint32_t i = 0; i < now.count[Boxes]; ++i) boxStep(now.slots[Boxes][i], next);
            const auto& [nodes, leaves, done, went] = inMeshes_;
            for (std::uint32_t i = 0; i < nodes.size(); ++i) nodeStep(nodes.slot(i), nodes.ref(i));
            for (std::uint32_t i = 0; i < leaves.size(); ++i)
                leafStep(leaves.slot(i), leaves.ref(i), next);
            for (std::uint32_t i = 0; i < now.count[Entries]; ++i)
                enter(now.slots[Entries][i], next);
            for (std::uint32_t i = 0; i < now.count[Tests]; ++i) test(now.slots[Tests][i]);
            inMeshes_.sort();
            for (std::uint32_t i = 0; i < done.size(); ++i) leave(done.slot(i), next);
        }
    }

private:
    static constexpr std::uint32_t kSlots = PlacedKernel::kSlots;

    // What a ray does next that is not in the tree of a mesh: a step in the tree over the boxes,
    // going into a mesh, or tests of its triangles.
    enum Place { Boxes, Entries, Tests, kPlaces };
    using SlotList = std::uint32_t[kSlots];
    struct Lists {
        SlotList* slots;
        std::uint32_t count[kPlaces] = {};
        explicit Lists(SlotList* memory) : slots(memory) {}
        void clear() { std::fill_n(count, kPlaces, 0u); }
        void add(Place place, std::uint32_t slot) { slots[place][count[place]++] = slot; }
    };

    struct Stacks {
        std::uint32_t *refs = nullptr, *entries = nullptr;
    };

    struct alignas(64) Slot {
        MeshRay mesh;
        std::uint32_t top; // of its stack in the tree of the mesh
        // Boxes of meshes in the scene.
        float rScene[3], nearScene[3], farScene[3], sceneCut;
        std::uint32_t sceneAt, sceneTop;
    };

    // ---- the tree over the boxes

    // Rays that come near the meshes, before they have a slot.
    struct alignas(64) Waiting {
        float r[3][W], nearOffset[3][W], farOffset[3][W], zCut[W];
        std::uint32_t ray[W];
        unsigned lanes = 0;
    };

    // The next W rays of the order.
    void prepare() {
        const std::size_t count = std::min<std::size_t>(W, order_.size() - next_);
        RayColumns columns = loadRays(rays_, &order_[next_], count, waiting_.ray);
        alignas(64) float limit[W];
        for (int i = 0; i < W; ++i) limit[i] = query_.limit(waiting_.ray[i]);
        columns.tMax = Floats::load(limit);
        next_ += count;
        const RayLanes rays(columns, tree_.extent);
        const Floats zCut = rays.cutAt(columns.tMax);
        Floats entry;
        waiting_.lanes = rays.traceable & bits(columns.tMin < columns.tMax) &
                         rays.entering(whole_, zCut, entry) & ((1u << count) - 1);
        if (waiting_.lanes == 0) return;
        for (int axis = 0; axis < 3; ++axis) {
            rays.r[axis].store(waiting_.r[axis]);
            rays.nearOffset[axis].store(waiting_.nearOffset[axis]);
            rays.farOffset[axis].store(waiting_.farOffset[axis]);
        }
        zCut.store(waiting_.zCut);
    }

    void start(std::uint32_t slot, Lists& to) {
        while (waiting_.lanes == 0) {
            if (next_ == order_.size()) return;
            prepare();
        }
        const auto lane = static_cast<std::size_t>(std::countr_zero(waiting_.lanes));
        waiting_.lanes &= waiting_.lanes - 1;
        Slot& s = slots_[slot];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            s.rScene[axis] = waiting_.r[axis][lane];
            s.nearScene[axis] = waiting_.nearOffset[axis][lane];
            s.farScene[axis] = waiting_.farOffset[axis][lane];
        }
        s.sceneCut = waiting_.zCut[lane];
        s.sceneAt = wideRef(0, WideKind::Node);
        s.sceneTop = 1;
        inScene_.refs[slot * sceneStride_] = wideRef(0, WideKind::None);
        inScene_.entries[slot * sceneStride_] = 0;
        ++live_;
        query_.start(slot, waiting_.ray[lane]);
        to.add(Boxes, slot);
    }

    void sendInScene(std::uint32_t slot, WideRef ref, Lists& to) {
        slots_[slot].sceneAt = ref;
        if (kindOf(ref) == WideKind::None) {
            --live_;
            start(slot, to);
        } else {
            to.add(kindOf(ref) == WideKind::Node ? Boxes : Entries, slot);
        }
    }
    void popInScene(std::uint32_t slot, Lists& to) {
        Slot& s = slots_[slot];
        sendInScene(slot, inScene_.refs[slot * sceneStride_ + --s.sceneTop], to);
    }

    // RaySetup::enters() for W boxes.
    void boxStep(std::uint32_t slot, Lists& to) {
        Slot& s = slots_[slot];
        const auto& node = tree_.node<W>(s.sceneAt);
        Floats entry(0.0f), exit(s.sceneCut);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t back = s.rScene[axis] < 0;
            const Floats r(s.rScene[axis]);
            const Floats front = Floats::load(node.plane[axis][back]) * r;
            const Floats behind = Floats::load(node.plane[axis][1 - back]) * r;
            entry = max(front + Floats(s.nearScene[axis]), entry);
            exit = min(behind + Floats(s.farScene[axis]), exit);
        }
        const unsigned hit = bits(entry <= exit);
        if (hit == 0) return popInScene(slot, to);
        const std::size_t at = slot * sceneStride_ + s.sceneTop;
        s.sceneTop += static_cast<std::uint32_t>(std::popcount(hit)) - 1;
        sendInScene(slot, push(hit, entry, node.child, inScene_, at), to);
    }

    // RaySetup::enters() for the box of a mesh.
    bool enters(const Slot& s, const Bounds& box, float& zEntry) const {
        float exit = s.sceneCut;
        zEntry = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool back = s.rScene[axis] < 0;
            const float front = (back ? box.hi[axis] : box.lo[axis]) * s.rScene[axis];
            const float behind = (back ? box.lo[axis] : box.hi[axis]) * s.rScene[axis];
            zEntry = ::max(front + s.nearScene[axis], zEntry);
            exit = ::min(behind + s.farScene[axis], exit);
        }
        return zEntry <= exit;
    }

    void enter(std::uint32_t slot, Lists& to) {
        Slot& s = slots_[slot];
        const std::uint32_t place = s.sceneAt >> 2;
        const SolidTree::Solid& solid = tree_.solids[place];
        const bool counts = NearFirst || solid.hides;
        float zEntry = 0;
        if (!counts || !enters(s, tree_.boxes[place], zEntry)) return popInScene(slot, to);
        TreeVisit visit;
        if (!query_.enter(slot, solid.number, zEntry, visit)) return leave(slot, to);
        s.mesh.enter(visit);
        s.top = 1;
        inMesh_.refs[slot * stride_] = wideRef(0, WideKind::None); // the end of the stack
        inMesh_.entries[slot * stride_] = 0;
        send(slot, visit.tree->root);
    }

    void leave(std::uint32_t slot, Lists& to) {
        Slot& s = slots_[slot];
        s.sceneCut = query_.leave(slot);
        if (s.sceneCut < 0) return sendInScene(slot, wideRef(0, WideKind::None), to);
        s.sceneTop = drop(inScene_, slot * sceneStride_, s.sceneTop, s.sceneCut);
        popInScene(slot, to);
    }

    // ---- the tree of a mesh

    [[gnu::always_inline]] void send(std::uint32_t slot, WideRef ref) {
        const MeshRay& mesh = slots_[slot].mesh;
        const std::byte* const line = mesh.base + byteOffset(ref);
        for (int k = 0; k < 4; ++k) __builtin_prefetch(line + std::ptrdiff_t{64} * k);
        __builtin_prefetch(mesh.longestSide + (ref >> 2));
        inMeshes_.went.add(slot, ref);
    }
    void popInMesh(std::uint32_t slot) {
        send(slot, inMesh_.refs[slot * stride_ + --slots_[slot].top]);
    }

    [[gnu::always_inline]] void nodeStep(std::uint32_t slot, WideRef ref) {
        Slot& s = slots_[slot];
        Floats entry;
        const unsigned hit = s.mesh.entered(ref, entry);
        const std::size_t at = slot * stride_ + s.top;
        const WideRef nearest = push(hit, entry, s.mesh.children(ref), inMesh_, at);
        // Without a child, what was on top before.
        const WideRef before = inMesh_.refs[at - 1];
        s.top = s.top + static_cast<std::uint32_t>(std::popcount(hit)) - 1;
        send(slot, hit != 0 ? nearest : before);
    }

    // Candidates are tested in the next round, when their corners are in the cache.
    [[gnu::always_inline]] void leafStep(std::uint32_t slot, WideRef ref, Lists& to) {
        Slot& s = slots_[slot];
        s.mesh.findCandidates(ref);
        if (s.mesh.candidates == 0) return popInMesh(slot);
        s.mesh.forEachCandidate([](std::uint32_t, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
            for (const Vec3d* corner : {&a, &b, &c}) // may lie in two lines
                __builtin_prefetch(&corner->x), __builtin_prefetch(&corner->z);
        });
        to.add(Tests, slot);
    }

    void test(std::uint32_t slot) {
        Slot& s = slots_[slot];
        float zCut = s.mesh.zCut;
        s.mesh.forEachCandidate(
            [&](std::uint32_t triangle, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
                if (zCut >= 0) zCut = query_.test(slot, triangle, a, b, c);
            });
        if (zCut < 0) s.top = 1; // only the end
        if (zCut < s.mesh.zCut) s.top = drop(inMesh_, slot * stride_, s.top, zCut);
        s.mesh.zCut = zCut;
        popInMesh(slot);
    }

    // ---- stacks

    // Puts the chosen children on a stack, the farthest first, and returns the nearest.
    static WideRef push(unsigned hit, Floats entry, const WideRef* child, const Stacks& stacks,
                        std::size_t at) {
        if constexpr (NearFirst)
            return pushSorted(maskOf(hit), std::popcount(hit), entry, child, stacks.refs + at,
                              stacks.entries + at);
        return pushAny(maskOf(hit), hit, child, stacks.refs + at);
    }

    // Takes out what starts behind the cut. Returns the new top.
    static std::uint32_t drop(const Stacks& stacks, std::size_t first, std::uint32_t top,
                              float zCut) {
        if (!NearFirst || zCut < 0) return top;
        return dropHidden(stacks.refs + first, stacks.entries + first, top, zCut);
    }

    const SolidTree& tree_;
    const Bounds whole_;
    PlacedQuery& query_;
    const RaySpan& rays_;
    std::span<const std::uint32_t> order_;
    Waiting waiting_;
    std::size_t sceneStride_, stride_, next_ = 0;
    Slot* slots_;
    Stacks inScene_, inMesh_;
    std::uint32_t live_ = 0;
    SlotList lists_[2][kPlaces];
    RayLists<kSlots> inMeshes_;
};

void closestPlaced(const PlacedTree& tree, PlacedQuery& query, const RaySpan& rays,
                   std::span<const std::uint32_t> order) {
    PlacedQueue<true>(tree, query, rays, order).run();
}
void anyPlaced(const PlacedTree& tree, PlacedQuery& query, const RaySpan& rays,
               std::span<const std::uint32_t> order) {
    PlacedQueue<false>(tree, query, rays, order).run();
}

LANES_END
