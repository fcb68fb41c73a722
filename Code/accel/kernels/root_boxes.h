// The boxes below the root of a tree, for W rays at once.
#pragma once

#include "accel/kernels/queue_rays.h"
#include "accel/kernels/wide_tree.h"
#include "base/bounds.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// Lanes whose rays enter a box; RaySetup::enters().
inline unsigned raysEntering(const RayBlock& b, const Bounds& box) {
    Floats entry(0.0f), exit = Floats::load(b.zCut);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Floats r = Floats::load(b.r[axis]), lo(box.lo[axis]), hi(box.hi[axis]);
        const Mask backwards = r < Floats(0.0f);
        entry = max(fma(select(backwards, hi, lo), r, Floats::load(b.nearOffset[axis])), entry);
        exit = min(fma(select(backwards, lo, hi), r, Floats::load(b.farOffset[axis])), exit);
    }
    return bits(entry <= exit);
}

// The children of the root, asked one by one for W rays, and boxes around all of them and around
// all but the largest: what stands on a wide floor is met by few of the rays that leave it.
struct RootBoxes {
    const WideNode<W>& node;
    std::size_t count = 0, largest = 0;
    Bounds whole, others;

    explicit RootBoxes(const WideTree& tree) : node(tree.at<WideNode<W>>(tree.root)) {
        float most = -1;
        for (; count < W && (*this)[count].lo.x <= (*this)[count].hi.x; ++count) {
            const Bounds box = (*this)[count];
            whole.extend(box);
            if (box.halfArea() > most) most = box.halfArea(), largest = count;
        }
        for (std::size_t i = 0; i < count; ++i)
            if (i != largest) others.extend((*this)[i]);
    }
    Bounds operator[](std::size_t child) const { return node.box(child); }
};

// Which rays enter the tree at all.
class RootQuestion {
public:
    explicit RootQuestion(const WideTree& tree) : root_(tree) {}

    // Of the lanes those whose rays enter a child of the root. All of them, where most rays do:
    // then it is quicker not to ask W rays at once what each will ask itself.
    unsigned entering(const RayBlock& b, unsigned lanes) {
        if (asked_ >= 4 * W && missed_ * 8 < asked_) return lanes;
        const unsigned near = raysEntering(b, root_.whole) & lanes;
        unsigned entered = 0;
        if (near != 0) {
            entered = raysEntering(b, root_[root_.largest]) & near;
            const unsigned most = entered | (raysEntering(b, root_.others) & near);
            for (std::size_t i = 0; i < root_.count && entered != most; ++i)
                entered |= raysEntering(b, root_[i]) & most;
        }
        asked_ += W;
        missed_ += static_cast<std::uint32_t>(std::popcount(lanes & ~entered));
        return entered;
    }

private:
    const RootBoxes root_;
    std::uint32_t asked_ = 0, missed_ = 0; // rays
};

LANES_END
