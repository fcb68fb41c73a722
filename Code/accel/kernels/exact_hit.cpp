#include "accel/kernels/exact_hit.h"

#include "accel/triangle.h"

#include <bit>

namespace {

template <int W> float keyOf(const RaySetup& setup, const WideLeaf<W>& leaf, unsigned lane) {
    const auto point = [&](int k) {
        const std::uint8_t i = leaf.corner[k][lane];
        return Vec3{leaf.point[0][i], leaf.point[1][i], leaf.point[2][i]};
    };
    return canonicalKey(setup, point(0), point(1), point(2));
}

constexpr auto makeChosenLanes() {
    std::array<std::array<std::uint8_t, 8>, 256> table{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        std::size_t n = 0;
        for (unsigned lane = 0; lane < 8; ++lane)
            if (mask >> lane & 1) table[mask][n++] = static_cast<std::uint8_t>(lane);
    }
    return table;
}

} // namespace

constexpr std::array<std::array<std::uint8_t, 8>, 256> kChosenLanes = makeChosenLanes();

template <int W>
float exactKey(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lane) {
    return keyOf(RaySetup(org, dir, mesh.extent), leaf, lane);
}

template <int W>
bool improve(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lanes,
             RayBest& best) {
    const RaySetup setup(org, dir, mesh.extent);
    bool better = false;
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<unsigned>(std::countr_zero(lanes));
        const float key = keyOf(setup, leaf, lane);
        if (!(key > 0 && key < best.below) || key < best.key) continue;
        const std::uint32_t triangle = mesh.tree.triangleIds[leaf.first + lane];
        if (key == best.key && triangle > best.triangle) continue;
        best.key = key;
        best.triangle = triangle;
        best.lane = lane;
        better = true;
    }
    return better;
}

template <int W>
bool hits(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lanes,
          const RayBest& best) {
    const RaySetup setup(org, dir, mesh.extent);
    for (; lanes != 0; lanes &= lanes - 1) {
        const float key = keyOf(setup, leaf, static_cast<unsigned>(std::countr_zero(lanes)));
        if (key > best.key && key < best.below) return true;
    }
    return false;
}

#define EXACT_HIT_FOR(W)                                                                           \
    template float exactKey(const WideMesh&, Vec3, Vec3, const WideLeaf<W>&, unsigned);            \
    template bool improve(const WideMesh&, Vec3, Vec3, const WideLeaf<W>&, unsigned, RayBest&);    \
    template bool hits(const WideMesh&, Vec3, Vec3, const WideLeaf<W>&, unsigned, const RayBest&);
EXACT_HIT_FOR(8)
EXACT_HIT_FOR(16)
#undef EXACT_HIT_FOR

std::byte* scratchMemory(std::size_t bytes) {
    thread_local std::vector<WideTree::Line> lines;
    const std::size_t wanted = (bytes + sizeof(WideTree::Line) - 1) / sizeof(WideTree::Line);
    if (lines.size() < wanted) lines.resize(wanted);
    return reinterpret_cast<std::byte*>(lines.data());
}
