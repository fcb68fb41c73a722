// The table of placed kernels, and how deep their stacks become.
#include "accel/kernels/placed.h"

#include <algorithm>
#include <string_view>

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

#define PLACED_FUNCTIONS(isa)                                                                      \
    namespace kernels::isa {                                                                       \
    void closestPlaced(const PlacedTree&, PlacedQuery&, const RaySpan&,                            \
                       std::span<const std::uint32_t>);                                            \
    void anyPlaced(const PlacedTree&, PlacedQuery&, const RaySpan&,                                \
                   std::span<const std::uint32_t>);                                                \
    }
PLACED_FUNCTIONS(sse)
PLACED_FUNCTIONS(avx2)
PLACED_FUNCTIONS(avx512)
#undef PLACED_FUNCTIONS

const PlacedKernel* placedKernel(const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr PlacedKernel kTable[] = {
        {"avx512", kernels::avx512::closestPlaced, kernels::avx512::anyPlaced},
        {"avx2", kernels::avx2::closestPlaced, kernels::avx2::anyPlaced},
        {"sse", kernels::sse::closestPlaced, kernels::sse::anyPlaced},
    };
    for (const PlacedKernel& row : kTable)
        if (std::string_view(row.name) == kernel.name) return &row;
#endif
    return nullptr;
}
