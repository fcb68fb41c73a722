#include "bench/walk.h"

#include "accel/triangle.h"

#include <algorithm>

namespace {

template <int W> struct WideView {
    const WideTree& tree;

    WideRef root() const { return tree.root; }
    static bool isLeaf(WideRef at) { return kindOf(at) == WideKind::Leaf; }
    std::span<const std::uint32_t> triangles(WideRef at) const {
        const auto& leaf = tree.at<WideLeaf<W>>(at);
        return std::span(tree.triangleIds).subspan(leaf.first, leaf.count);
    }
    template <class Fn> void forEachChild(WideRef at, Fn&& child) const {
        const auto& node = tree.at<WideNode<W>>(at);
        for (std::size_t i = 0; i < W; ++i) child(node.child[i], node.box(i));
    }
};

template <class Tree>
void walk(const Tree& tree, const MeshGeometry& geometry, const Ray& ray, bool anyHit,
          BenchWalk& count) {
    struct Entry {
        std::uint32_t at;
        float z;
    };
    const RaySetup setup(ray.org, ray.dir, geometry.extent);
    float zCut = depthCut(1.0f / (ray.tMax * setup.dz));
    std::vector<Entry> stack{{tree.root(), 0}};
    while (!stack.empty()) {
        const Entry entry = stack.back();
        stack.pop_back();
        if (entry.z > zCut) continue;
        if (!tree.isLeaf(entry.at)) {
            ++count.nodes;
            const auto others = static_cast<std::ptrdiff_t>(stack.size());
            tree.forEachChild(entry.at, [&](std::uint32_t child, const Bounds& box) {
                float z = 0;
                if (setup.enters(box, zCut, z)) stack.push_back({child, z});
            });
            std::sort(stack.begin() + others, stack.end(),
                      [](const Entry& a, const Entry& b) { return a.z > b.z; });
            continue;
        }
        ++count.leaves;
        for (const std::uint32_t triangle : tree.triangles(entry.at)) {
            const auto& c = geometry.triangles[triangle];
            const float key = canonicalKey(setup, geometry.points[c[0]], geometry.points[c[1]],
                                           geometry.points[c[2]]);
            const float t = 1.0f / (key * setup.dz);
            if (!(key > 0 && t > ray.tMin && t < ray.tMax)) continue;
            if (anyHit) return;
            zCut = min(depthCut(key), zCut);
        }
    }
}

template <class Tree>
BenchWalk meanWalkIn(const Tree& tree, const MeshGeometry& geometry, const BenchRays& rays) {
    constexpr std::size_t kStride = 16;
    BenchWalk sum;
    double count = 0;
    const RaySpan all{rays.org, rays.dir, rays.tMin, rays.tMax, rays.time};
    for (std::size_t i = 0; i < all.size(); i += kStride, ++count)
        walk(tree, geometry, all[i], rays.anyHit, sum);
    return count > 0 ? BenchWalk{sum.nodes / count, sum.leaves / count} : sum;
}

} // namespace

BenchWalk meanWalk(const MeshGeometry& geometry, const BenchRays& rays) {
    if (geometry.wide.width == 16) return meanWalkIn(WideView<16>{geometry.wide}, geometry, rays);
    if (geometry.wide.width == 8) return meanWalkIn(WideView<8>{geometry.wide}, geometry, rays);
    return {};
}
