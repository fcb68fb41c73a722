#include "accel/bvh.h"

#include <algorithm>

double sahCost(const Bvh& bvh) {
    if (bvh.nodes.empty()) return 0;
    const auto areaOf = [](const Bounds& box) {
        const Vec3d d = toDouble(box.hi) - toDouble(box.lo);
        return d.x * d.y + d.y * d.z + d.z * d.x;
    };
    double sum = 0;
    for (const BvhNode& node : bvh.nodes)
        sum += areaOf(node.box) * (node.isLeaf() ? node.count : 1);
    const double root = areaOf(bvh.nodes[0].box);
    return root > 0 ? sum / root : static_cast<double>(bvh.nodes.size());
}

std::size_t leafCount(const Bvh& bvh) {
    return static_cast<std::size_t>(std::count_if(bvh.nodes.begin(), bvh.nodes.end(),
                                                  [](const BvhNode& n) { return n.isLeaf(); }));
}
