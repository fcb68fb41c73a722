// Bvh: a binary bounding volume hierarchy over boxes, and its traversal. It never sees a primitive:
// the builder knows boxes, the traversal knows rays and calls back with primitive numbers.
#pragma once

#include "accel/ray_setup.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

struct BvhNode {
    Bounds box;
    std::uint32_t first =
        0; // inner: index of the left child, the right one follows; leaf: in primIds
    std::uint32_t count = 0; // primitives of a leaf, 0 for an inner node
    bool isLeaf() const { return count != 0; }
};
static_assert(sizeof(BvhNode) == 32);

struct Bvh {
    std::vector<BvhNode> nodes; // root first; empty when there is nothing to find
    std::vector<std::uint32_t> primIds;
    std::size_t bytes() const { return nodes.size() * sizeof(BvhNode) + primIds.size() * 4; }
};

// Binned SAH, top down (Wald 2007), the same tree on every machine. Depth is at most kMaxDepth for
// any input: a split that does not separate centres halves the list instead. `nodes` may have room
// to spare: giving that back means a copy, best made when the boxes are gone.
Bvh buildBvh(std::span<const Bounds> boxes, int threads = 1);

// Expected cost of a ray through the tree by the surface area heuristic, node and primitive 1 each.
double sahCost(const Bvh& bvh);
std::size_t leafCount(const Bvh& bvh);

inline constexpr int kMaxBvhDepth = 96;

inline bool enters(const RaySetup& ray, const Bvh& bvh, std::uint32_t node, float zCut,
                   float& zEntry) {
    return ray.enters(bvh.nodes[node].box, zCut, zEntry);
}

// Visits the leaves in the order of their entry depth. leaf(primId, zCut) is called for every
// primitive of a leaf that the ray enters in front of zCut; it may lower zCut; true stops.
// The ray is a RaySetup, or what else says with enters() which nodes it enters.
template <class BoxRay, class LeafFn>
void traverse(const Bvh& bvh, const BoxRay& ray, float zCut, LeafFn&& leaf) {
    struct Entry {
        std::uint32_t node;
        float z;
    };
    if (bvh.nodes.empty()) return;
    std::array<Entry, kMaxBvhDepth + 1> stack;
    std::size_t size = 0;
    float z = 0;
    if (!enters(ray, bvh, 0, zCut, z)) return;
    std::uint32_t at = 0;
    for (;;) {
        const BvhNode& node = bvh.nodes[at];
        if (node.isLeaf()) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                if (leaf(bvh.primIds[i], zCut)) return;
        } else {
            float zLeft = 0, zRight = 0;
            const bool left = enters(ray, bvh, node.first, zCut, zLeft);
            const bool right = enters(ray, bvh, node.first + 1, zCut, zRight);
            if (left && right) {
                const bool leftFirst = zLeft <= zRight;
                stack[size++] = {node.first + (leftFirst ? 1u : 0u), leftFirst ? zRight : zLeft};
                at = node.first + (leftFirst ? 0u : 1u);
                continue;
            }
            if (left || right) {
                at = node.first + (left ? 0u : 1u);
                continue;
            }
        }
        // Strictly behind the best hit: an equally near one with a lower number must still be seen.
        do {
            if (size == 0) return;
            --size;
        } while (stack[size].z > zCut);
        at = stack[size].node;
    }
}
