// The slots of rays that are on their way at once: their columns in blocks of W rays, and stacks of
// the nodes that they go to later, as stack.h has them.
#pragma once

#include "accel/kernels/exact_hit.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/stack.h"
#include "accel/kernels/wide_tree.h"
#include "base/cpu.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// Where a ray's columns are, in bytes from those of the first ray.
using Slot = std::uint32_t;

// A ray's numbers: all columns of a block are at fixed distances from one address.
class QueueRay {
public:
    [[gnu::always_inline]] QueueRay(RayBlock* blocks, Slot slot)
        : first_(reinterpret_cast<std::byte*>(blocks) + slot) {
        // Where the compiler sees that it is a sum, it keeps blocks + column in a register for each
        // column; these are more than there are, and it fetches them from vector registers.
        asm("" : "+r"(first_));
    }

    template <class T> [[gnu::always_inline]] T& at(T (RayBlock::*column)[W]) const {
        return *reinterpret_cast<T*>(first_ + distance(column));
    }
    template <class T>
    [[gnu::always_inline]] T& at(T (RayBlock::*columns)[3][W], std::size_t axis) const {
        return *reinterpret_cast<T*>(first_ + distance(columns) + axis * sizeof(T[W]));
    }

private:
    // A pointer to a member is this number in the ABI of all compilers that know the asm above.
    template <class Column> static std::ptrdiff_t distance(Column RayBlock::*column) {
        return std::bit_cast<std::ptrdiff_t>(column);
    }

    std::byte* first_;
};

class QueueSlots {
public:
    static constexpr std::uint32_t kSlots = 96, kBlocks = kSlots / W;
    static_assert(kSlots % W == 0);

    // `used`: slots that will ever have a ray.
    QueueSlots(const WideTree& tree, std::size_t used)
        : base_(tree.base()), prefetches_(tree.lines.size() > kManyLines) {
        const std::size_t stride = strideOfStacks(tree.stackSize);
        const std::size_t stacks = kSlots * stride * sizeof(std::uint32_t);
        std::byte* const memory = scratchMemory(kBlocks * sizeof(RayBlock) + 2 * stacks);
        blocks_ = reinterpret_cast<RayBlock*>(memory);
        refs_ = reinterpret_cast<std::uint32_t*>(memory + kBlocks * sizeof(RayBlock));
        entries_ = refs_ + kSlots * stride;
        for (std::uint32_t i = 0; i < std::min<std::size_t>(kSlots, used); ++i) {
            const auto bottom = static_cast<std::uint32_t>(i * stride);
            blocks_[i / W].bottom[i % W] = bottom;
            refs_[bottom] = wideRef(0, WideKind::None); // the end of every stack
            entries_[bottom] = 0;
        }
    }

    static constexpr Slot slotOf(std::uint32_t block, std::uint32_t lane) {
        return block * static_cast<std::uint32_t>(sizeof(RayBlock)) + lane * 4;
    }
    static std::uint32_t blockOf(Slot slot) { return slot / std::uint32_t{sizeof(RayBlock)}; }
    static std::uint32_t laneOf(Slot slot) { return slot % std::uint32_t{sizeof(RayBlock)} / 4; }

    RayBlock& block(std::uint32_t number) { return blocks_[number]; }
    RayBlock* blocks() { return blocks_; }

    [[gnu::always_inline]] QueueRay ray(Slot slot) const { return {blocks_, slot}; }

    // The stack of a ray: its top is a place among those of all stacks.
    std::uint32_t* refs(std::uint32_t place) const { return refs_ + place; }
    std::uint32_t* entries(std::uint32_t place) const { return entries_ + place; }
    // Of W rays that enter the tree.
    void start(std::uint32_t block) {
        RayBlock& b = blocks_[block];
        for (std::uint32_t i = 0; i < W; ++i) b.stackTop[i] = b.bottom[i] + 1;
    }
    static void leaveOnlyEnd(const QueueRay& ray) {
        ray.at(&RayBlock::stackTop) = ray.at(&RayBlock::bottom) + 1;
    }
    // What the best hit hides is taken off.
    void dropBehind(const QueueRay& ray) const {
        const std::uint32_t bottom = ray.at(&RayBlock::bottom);
        std::uint32_t& top = ray.at(&RayBlock::stackTop);
        if (top == bottom + 1) return; // nothing but the end
        top = bottom +
              dropHidden(refs_ + bottom, entries_ + bottom, top - bottom, ray.at(&RayBlock::zCut));
    }

    // What is on top of its stack.
    [[gnu::always_inline]] WideRef pop(const QueueRay& ray) const {
        const WideRef ref = refs_[--ray.at(&RayBlock::stackTop)];
        prefetch(ref);
        return ref;
    }

    [[gnu::always_inline]] const std::byte* nodeAt(WideRef ref) const {
        return base_ + byteOffset(ref);
    }
    [[gnu::always_inline]] const WideLeaf<W>& leafAt(WideRef ref) const {
        return *reinterpret_cast<const WideLeaf<W>*>(nodeAt(ref));
    }
    [[gnu::always_inline]] void prefetch(WideRef ref) const {
        if (!prefetches_) return;
        for (int k = 0; k < 4; ++k) __builtin_prefetch(nodeAt(ref) + std::ptrdiff_t{64} * k);
    }

private:
    // Of a tree that the caches don't hold; for others prefetches are work in vain. 4 MB.
    static constexpr std::size_t kManyLines = std::size_t{1} << 16;

    const std::byte* base_; // of the tree
    const bool prefetches_;
    RayBlock* blocks_;
    std::uint32_t *refs_, *entries_; // entries only for nearest hits
};

LANES_END
