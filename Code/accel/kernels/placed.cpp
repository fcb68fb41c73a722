// How deep the stacks of placed kernels become.
#include "accel/kernels/placed.h"

#include <algorithm>

namespace {

template <int W> std::uint32_t stackBelow(const SolidTree& tree, WideRef ref) {
    if (kindOf(ref) != WideKind::Node) return 0;
    const WideNode<W>& node = tree.node<W>(ref);
    std::uint32_t children = 0, below = 0;
    for (const WideRef child : node.child) {
        children += kindOf(child) != WideKind::None;
        below = std::max(stackBelow<W>(tree, child), below);
    }
    return children + below;
}

} // namespace

std::uint32_t stackSize(const SolidTree& tree) {
    if (tree.lines.empty()) return 1;
    constexpr WideRef kRoot = wideRef(0, WideKind::Node);
    return 1 + (tree.width == 16 ? stackBelow<16>(tree, kRoot) : stackBelow<8>(tree, kRoot));
}
