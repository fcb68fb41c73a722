// The slots of rays that are on their way at once: their columns in blocks of W rays, stacks of the
// nodes that they go to later, as stack.inl has them, and lists of what they are at.
// Included by the file of each instruction set inside its namespace, in front of queue.inl.

// Where a ray's columns are, in bytes from those of the first ray: a step adds it to addresses that
// are the same for all rays, and computes nothing.
using Slot = std::uint32_t;

class QueueSlots {
public:
    static constexpr std::uint32_t kSlots = 96, kBlocks = kSlots / W;

    // What the rays are at. One place more than rays: send() writes to lists that are full.
    struct Lists {
        Slot nodes[kSlots + 1], leaves[kSlots + 1], done[kSlots + 1];
    };
    struct Counts {
        std::uint32_t nodes = 0, leaves = 0, done = 0;
    };

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

    // The ray's number in a column.
    template <class T> [[gnu::always_inline]] T& at(Slot slot, T (RayBlock::*column)[W]) const {
        return in(blocks_->*column, slot);
    }
    template <class T>
    [[gnu::always_inline]] T& at(Slot slot, T (RayBlock::*columns)[3][W], std::size_t axis) const {
        return in((blocks_->*columns)[axis], slot);
    }

    // The stack of a ray: its top is a place among those of all stacks.
    std::uint32_t* refs(std::uint32_t place) const { return refs_ + place; }
    std::uint32_t* entries(std::uint32_t place) const { return entries_ + place; }
    // Of W rays that enter the tree.
    void start(std::uint32_t block, WideRef root) {
        RayBlock& b = blocks_[block];
        Ints(root).store(b.at);
        for (std::uint32_t i = 0; i < W; ++i) b.stackTop[i] = b.bottom[i] + 1;
    }
    void leaveOnlyEnd(Slot slot) const {
        at(slot, &RayBlock::stackTop) = at(slot, &RayBlock::bottom) + 1;
    }
    // What the best hit hides is taken off.
    void dropBehind(Slot slot) const {
        const std::uint32_t bottom = at(slot, &RayBlock::bottom);
        std::uint32_t& top = at(slot, &RayBlock::stackTop);
        top = bottom + dropHidden(refs_ + bottom, entries_ + bottom, top - bottom,
                                  at(slot, &RayBlock::zCut));
    }

    // ---- where rays go

    // Takes the ray to `ref`: three stores, of which one counts.
    [[gnu::always_inline]] void send(Slot slot, WideRef ref, Lists& to, Counts& count) const {
        at(slot, &RayBlock::at) = ref;
        const std::byte* const line = base_ + byteOffset(ref);
        if (prefetches_)
            for (int k = 0; k < 4; ++k) __builtin_prefetch(line + std::ptrdiff_t{64} * k);
        to.nodes[count.nodes] = slot;
        to.leaves[count.leaves] = slot;
        to.done[count.done] = slot;
        count.nodes += kindOf(ref) == WideKind::Node;
        count.leaves += kindOf(ref) == WideKind::Leaf;
        count.done += kindOf(ref) == WideKind::None;
    }
    // To what is on top of its stack.
    [[gnu::always_inline]] void pop(Slot slot, Lists& to, Counts& count) const {
        send(slot, refs_[--at(slot, &RayBlock::stackTop)], to, count);
    }

private:
    // Of a tree that the caches don't hold; for others prefetches are work in vain. 4 MB.
    static constexpr std::size_t kManyLines = std::size_t{1} << 16;

    template <class T> [[gnu::always_inline]] static T& in(T (&column)[W], Slot slot) {
        return *reinterpret_cast<T*>(reinterpret_cast<std::byte*>(column) + slot);
    }

    const std::byte* base_; // of the tree
    const bool prefetches_;
    RayBlock* blocks_;
    std::uint32_t *refs_, *entries_; // entries only for nearest hits
};
