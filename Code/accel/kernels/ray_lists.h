// What many rays that take their steps one by one are at, and go to. A ray is known by a number,
// its slot.
#pragma once

#include "accel/kernels/wide_tree.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstdint>

LANES_BEGIN

// Rays, and the node or leaf of each.
template <std::uint32_t Slots> class RayList {
    static_assert(Slots % W == 0);

public:
    std::uint32_t size() const { return size_; }
    std::uint32_t slot(std::uint32_t i) const { return slots_[i]; }
    WideRef ref(std::uint32_t i) const { return refs_[i]; }

    void clear() { size_ = 0; }
    void add(std::uint32_t slot, WideRef ref) { set(size_++, slot, ref); }
    // In loops whose other stores would keep the size out of registers.
    [[gnu::always_inline]] void set(std::uint32_t i, std::uint32_t slot, WideRef ref) {
        slots_[i] = slot, refs_[i] = ref;
    }
    void resize(std::uint32_t size) { size_ = size; }

    // For those who look at W at a time: what is behind the last one is of no kind.
    void end() { std::fill_n(refs_ + size_, W, WideRef{3}); }
    // Of the W from `first` on.
    Ints kinds(std::uint32_t first) const { return Ints::load(refs_ + first) & Ints(3); }
    // Adds those of the W from `first` on that are at what is of this kind.
    void add(const RayList& from, std::uint32_t first, Ints kinds, WideKind kind) {
        const unsigned chosen = bits(kinds == Ints(static_cast<std::uint32_t>(kind)));
        const Ints slots = Ints::load(from.slots_ + first), refs = Ints::load(from.refs_ + first);
        storeChosen(chosen, slots, slots_ + size_);
        storeChosen(chosen, refs, refs_ + size_);
        size_ += static_cast<std::uint32_t>(std::popcount(chosen));
    }

private:
    alignas(64) std::uint32_t slots_[Slots + W];
    alignas(64) WideRef refs_[Slots + W];
    std::uint32_t size_ = 0;
};

// Rays by what they are at. A step writes where its ray goes behind what the steps before it wrote,
// and sort() makes the lists. If each step chose the list itself, its store would have an address
// that depends on all steps before, and processors that have seen such an address be that of a load
// keep the loads of the next steps waiting for it.
template <std::uint32_t Slots> class RayLists {
public:
    RayList<Slots> nodes, leaves, done, went;

    // A ray goes on outside of the steps.
    void send(std::uint32_t slot, WideRef ref) {
        (kindOf(ref) == WideKind::Node   ? nodes
         : kindOf(ref) == WideKind::Leaf ? leaves
                                         : done)
            .add(slot, ref);
    }
    // What the rays in `went` go to is all that there is then.
    void sort() {
        nodes.clear(), leaves.clear(), done.clear();
        went.end();
        for (std::uint32_t i = 0; i < went.size(); i += W) {
            const Ints kinds = went.kinds(i);
            nodes.add(went, i, kinds, WideKind::Node);
            leaves.add(went, i, kinds, WideKind::Leaf);
            done.add(went, i, kinds, WideKind::None);
        }
        went.clear();
    }
};

LANES_END
