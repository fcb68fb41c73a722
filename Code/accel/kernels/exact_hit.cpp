// What kernels call in plain code: see exact_hit.h.
#include "accel/kernels/exact_hit.h"

#include "accel/triangle.h"

namespace {

template <int W> float keyOf(const RaySetup& setup, const WideLeaf<W>& leaf, unsigned lane) {
    const auto point = [&](int k) {
        const std::uint8_t i = leaf.corner[k][lane];
        return Vec3{leaf.point[0][i], leaf.point[1][i], leaf.point[2][i]};
    };
    return canonicalKey(setup, point(0), point(1), point(2));
}

} // namespace

template <int W>
float exactKey(const WideMesh& mesh, Vec3 org, Vec3 dir, const WideLeaf<W>& leaf, unsigned lane) {
    return keyOf(RaySetup(org, dir, mesh.extent), leaf, lane);
}

template float exactKey(const WideMesh&, Vec3, Vec3, const WideLeaf<8>&, unsigned);
template float exactKey(const WideMesh&, Vec3, Vec3, const WideLeaf<16>&, unsigned);

std::byte* scratchMemory(std::size_t bytes) {
    thread_local std::vector<WideTree::Line> lines;
    const std::size_t wanted = (bytes + sizeof(WideTree::Line) - 1) / sizeof(WideTree::Line);
    if (lines.size() < wanted) lines.resize(wanted);
    return reinterpret_cast<std::byte*>(lines.data());
}
