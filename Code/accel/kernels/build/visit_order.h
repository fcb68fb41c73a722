// In which order a ray that any hit ends visits the children of a node: first where a hit is likely
// for what the visit costs. Large boxes first would be wrong where the walls of a room share leaves
// with what is in it, and leaves first where they are full of air.
#pragma once

#include "accel/kernels/build/collapse.h"

#include <algorithm>

namespace kernels::build {

// Of the rays that enter a box of this half area, the part that triangles of this area may stop.
inline float coverOf(float triangles, float halfArea) {
    const float cover = triangles / (triangles + halfArea);
    return cover >= 0 ? cover : 0; // NaN
}
// For leaves, where it is below 1: n triangles have n times the area of their box at most.
inline constexpr float kCoverUnit = 1.0f / 255;

// What is below a node, as a ray sees it that enters its box.
struct Prospect {
    float triangles = 0; // area
    float steps = 0;     // visits, the own one included
};

inline Prospect prospectOfLeaf(float cover, float halfArea) {
    constexpr float kSteps = 2; // a leaf takes as long as two nodes
    return {cover / (1 - cover) * halfArea, kSteps};
}

// Sorts the children, those to visit first at the end, and returns what their parent is. of(child):
// the prospect of a binary node.
template <int W, class ProspectFn>
Prospect sortForVisits(WideChildren<W>& children, std::span<const BinaryNode> nodes, float halfArea,
                       ProspectFn&& of) {
    struct Worth {
        float worth;
        std::uint32_t node;
    };
    std::array<Worth, W> sorted;
    Prospect whole{0, 1};
    for (std::size_t i = 0; i < children.count; ++i) {
        const std::uint32_t child = children.node[i];
        const float area = halfAreaOf(nodes[child]);
        const Prospect p = of(child);
        whole.triangles += p.triangles;
        whole.steps += p.steps * (area < halfArea ? area / halfArea : 1.0f);
        const float worth = coverOf(p.triangles, area) / p.steps;
        std::size_t place = i;
        for (; place > 0 && sorted[place - 1].worth > worth; --place)
            sorted[place] = sorted[place - 1];
        sorted[place] = {worth, child};
    }
    for (std::size_t i = 0; i < children.count; ++i) children.node[i] = sorted[i].node;
    return whole;
}

} // namespace kernels::build
