// The slots of rays that are on their way at once: their columns in blocks of W rays, and stacks of
// the nodes that they go to later, as stack.inl has them.
// Included by the file of each instruction set inside its namespace, in front of queue.inl.

// Where a ray's columns are, in bytes from those of the first ray: a step adds it to addresses that
// are the same for all rays, and computes nothing.
using Slot = std::uint32_t;

class QueueSlots {
public:
    static constexpr std::uint32_t kSlots = 96, kBlocks = kSlots / W;

    // `used`: slots that will ever have a ray.
    QueueSlots(const WideTree& tree, std::size_t used) {
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
    [[gnu::always_inline]] WideRef pop(Slot slot) const {
        return at(slot, &RayBlock::at) = refs_[--at(slot, &RayBlock::stackTop)];
    }
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

private:
    template <class T> [[gnu::always_inline]] static T& in(T (&column)[W], Slot slot) {
        return *reinterpret_cast<T*>(reinterpret_cast<std::byte*>(column) + slot);
    }

    RayBlock* blocks_;
    std::uint32_t *refs_, *entries_; // entries only for nearest hits
};
