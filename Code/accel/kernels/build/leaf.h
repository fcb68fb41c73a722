// Leaves.
#pragma once

#include "accel/kernels/build/box.h"
#include "accel/kernels/build/build.h"
#include "accel/kernels/build/visit_order.h"
#include "accel/kernels/wide_tree.h"
#include "base/vec.h"
#include "simd/region.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <immintrin.h>

LANES_BEGIN
namespace build {
using namespace kernels::build;

// False when the triangles have more than W different points.
template <int W>
inline bool makeLeaf(const BuildInput& in, const PrimBox* prims, const BuildRange& r,
                     Grown& grown) {
    WideLeaf<W> leaf;
    std::memset(&leaf, 0, sizeof leaf); // what is between the members, too: trees compare by bytes
    NumberSet<W> known;
    known.fill(0xffffffffu);
    std::uint32_t count = 0; // known ones are in front
    const auto placeOf = [&](unsigned found) {
        const auto at = std::countr_zero(found | std::uint64_t{1} << count);
        count += found == 0;
        return static_cast<std::uint32_t>(at);
    };
    for (std::uint32_t i = 0; i < r.count; ++i) {
        const auto [a, b, c] = in.triangles[prims[i].id()];
        // All three are looked for before one is added; one that comes twice costs a place.
        const unsigned foundA = known.find(a), foundB = known.find(b), foundC = known.find(c);
        const std::uint32_t atA = placeOf(foundA), atB = placeOf(foundB), atC = placeOf(foundC);
        if (count > W) return false;
        known.put(a, atA), known.put(b, atB), known.put(c, atC);
        leaf.corner[0][i] = static_cast<std::uint8_t>(atA);
        leaf.corner[1][i] = static_cast<std::uint8_t>(atB);
        leaf.corner[2][i] = static_cast<std::uint8_t>(atC);
    }
    alignas(64) std::array<std::uint32_t, W> points;
    known.store(points.data());
    for (std::uint32_t i = 0; i < W; ++i) {
        const Vec3& p = in.points[points[i < count ? i : 0]];
        for (std::size_t axis = 0; axis < 3; ++axis) leaf.point[axis][i] = p[axis];
    }
    leaf.first = r.first;
    leaf.count = static_cast<std::uint8_t>(r.count);
    __m128 sides = _mm_setzero_ps(); // products of two, in the lower three lanes
    for (std::uint32_t i = 0; i < r.count; ++i) {
        in.ids[r.first + i] = prims[i].id();
        const Box b = Box::load(prims[i]);
        const __m128 side = _mm_add_ps(b.lo(), b.negHi()); // both signs do
        const __m128 next = _mm_shuffle_ps(side, side, _MM_SHUFFLE(3, 0, 2, 1));
        sides = _mm_add_ps(sides, _mm_mul_ps(side, next));
    }
    alignas(16) std::array<float, 4> sum;
    _mm_store_ps(sum.data(), sides);
    // A triangle is half of its box's largest side, or less.
    leaf.cover = static_cast<std::uint8_t>(
        coverOf(0.5f * (sum[0] + sum[1] + sum[2]), halfAreaOf(leafNode(r.box))) / kCoverUnit);

    constexpr std::size_t kLines = sizeof(leaf) / sizeof(WideTree::Line);
    grown.lines.resize(grown.lines.size() + kLines);
    std::memcpy(grown.lines.data() + grown.lines.size() - kLines, &leaf, sizeof leaf);
    grown.nodes[r.node].leaf = grown.leaves++;
    return true;
}

} // namespace build
LANES_END
