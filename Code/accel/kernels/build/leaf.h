// Leaves.
#pragma once

#include "accel/kernels/build/box.h"
#include "accel/kernels/build/build.h"
#include "accel/kernels/build/visit_order.h"
#include "accel/kernels/wide_tree.h"
#include "base/vec.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace kernels::build {

// False when the triangles have more than W different points.
template <int W>
inline bool makeLeaf(const BuildInput& in, const PrimBox* prims, const BuildRange& r,
                     Grown& grown) {
    WideLeaf<W> leaf;
    std::memset(&leaf, 0, sizeof leaf); // what is between the members, too: trees compare by bytes
    std::array<std::uint32_t, W> points{};
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < r.count; ++i) {
        const Corners& corners = in.triangles[prims[i].id()];
        // All three are looked for before one is added; one that comes twice costs a place.
        std::array<std::uint32_t, 3> at;
        const std::uint32_t known = count;
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = static_cast<std::uint32_t>(
                std::find(points.data(), points.data() + known, corners[k]) - points.data());
        for (std::size_t k = 0; k < 3; ++k) {
            if (at[k] == known) {
                if (count == W) return false;
                at[k] = count;
                points[count++] = corners[k];
            }
            leaf.corner[k][i] = static_cast<std::uint8_t>(at[k]);
        }
    }
    for (std::uint32_t i = 0; i < W; ++i) {
        const Vec3& p = in.points[points[i < count ? i : 0]];
        for (std::size_t axis = 0; axis < 3; ++axis) leaf.point[axis][i] = p[axis];
    }
    leaf.first = r.first;
    leaf.count = static_cast<std::uint8_t>(r.count);
    Four sides{}; // products of two
    for (std::uint32_t i = 0; i < r.count; ++i) {
        in.ids[r.first + i] = prims[i].id();
        sides += Box::load(prims[i]).sideProducts();
    }
    // A triangle is half of its box's largest side, or less.
    leaf.cover = static_cast<std::uint8_t>(
        coverOf(0.5f * (sides[0] + sides[1] + sides[2]), halfAreaOf(leafNode(r.box))) / kCoverUnit);

    constexpr std::size_t kLines = sizeof(leaf) / sizeof(WideTree::Line);
    grown.lines.resize(grown.lines.size() + kLines);
    std::memcpy(grown.lines.data() + grown.lines.size() - kLines, &leaf, sizeof leaf);
    grown.nodes[r.node].leaf = grown.leaves++;
    return true;
}

} // namespace kernels::build
