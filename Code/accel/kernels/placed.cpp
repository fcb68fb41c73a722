// The table of placed kernels, and how deep their stacks become.
#include "accel/kernels/placed.h"

#include "accel/kernels/by_kernel.h"

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

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void closestPlaced(const PlacedTree&, PlacedQuery&, const RaySpan&,                            \
                       std::span<const std::uint32_t>);                                            \
    void anyPlaced(const PlacedTree&, PlacedQuery&, const RaySpan&,                                \
                   std::span<const std::uint32_t>);                                                \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    { kernels::isa::closestPlaced, kernels::isa::anyPlaced }

const PlacedKernel* placedKernel(const Kernel& kernel) {
    static constexpr ByKernel<PlacedKernel> kTable = BY_KERNEL(ROW);
    return kTable.of(kernel);
}
