// What W rays of the queue have met, written where the batch wants it.
#pragma once

#include "accel/kernels/chord.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

LANES_BEGIN

// Bits 0 to W - 1 as bytes 0 or 1.
inline void storeFlags(unsigned flags, std::uint8_t* to) {
    for (int i = 0; i < W; i += 8) {
        const std::uint64_t each = (flags >> i & 0xff) * 0x0101010101010101u;
        const std::uint64_t bit = each & 0x8040201008040201u; // bit i of byte i
        const std::uint64_t bytes = (bit + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
        std::memcpy(to + i, &bytes, 8);
    }
}

// With u and v, from the leaves of the best hits: they were in the cache not long ago.
inline void writeWhole(const RayBlock& b, const WideTree& tree, const float* t, unsigned found,
                       const HitLists& hits) {
    alignas(64) float point[3][3][W] = {}; // axis as in the block, corner
    for (unsigned lanes = found; lanes != 0; lanes &= lanes - 1) {
        const int i = std::countr_zero(lanes);
        const std::byte* const p = tree.base() + byteOffset(b.bestLeaf[i]);
        const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(p);
        for (int c = 0; c < 3; ++c) {
            const std::uint8_t corner = leaf.corner[c][b.bestLane[i]];
            for (int axis = 0; axis < 3; ++axis)
                point[axis][c][i] = reinterpret_cast<const float*>(p + b.axis[axis][i])[corner];
        }
    }
    Floats x[3], y[3];
    for (int c = 0; c < 3; ++c) {
        const auto relative = [&](int axis) {
            return Floats::load(point[axis][c]) - Floats::load(b.origin[axis]);
        };
        const Floats z = relative(2);
        x[c] = relative(0) - Floats::load(b.shearX) * z;
        y[c] = relative(1) - Floats::load(b.shearY) * z;
    }
    const Weights weights = barycentrics(x, y);
    alignas(64) float u[W], v[W];
    weights.u.store(u), weights.v.store(v);
    for (; found != 0; found &= found - 1) {
        const int i = std::countr_zero(found);
        hits.whole[b.ray[i]] = {t[i], u[i], v[i], b.triangle[i], hits.shape};
    }
}

inline void writeAnswers(const RayBlock& b, const WideTree& tree, const HitLists& hits) {
    const Floats t = Floats(1.0f) / (Floats::load(b.key) * Floats::load(b.dz));
    const Ints none(TriangleHit::kNone), triangle = Ints::load(b.triangle);
    const Mask hit = (triangle < none) & (t <= Floats::load(b.tMax));
    const unsigned found = bits(hit) & ((1u << b.count) - 1);
    if (hits.whole == nullptr && b.inARow) {
        storePairs(select(hit, t, Floats(kInfinityF)), select(hit, triangle, none),
                   &hits.brief[b.ray[0]].t);
        return;
    }
    alignas(64) float ts[W];
    t.store(ts);
    for (std::uint32_t i = 0; i < b.count; ++i) {
        if ((found >> i & 1) == 0)
            hits.miss(b.ray[i], b.tMax[i]);
        else if (hits.whole == nullptr)
            hits.brief[b.ray[i]] = {ts[i], b.triangle[i]};
    }
    if (hits.whole != nullptr && found != 0) writeWhole(b, tree, ts, found, hits);
}

inline void writeAnswers(const RayBlock& b, const WideTree&, std::uint8_t* hidden) {
    const unsigned found = bits(Ints::load(b.triangle) < Ints(TriangleHit::kNone));
    if (b.inARow) return storeFlags(found, hidden + b.ray[0]);
    for (std::uint32_t i = 0; i < b.count; ++i) hidden[b.ray[i]] = found >> i & 1;
}

LANES_END
