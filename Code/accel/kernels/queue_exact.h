// What is decided about a ray and a triangle in vectors: which pairs are worth the canonical key,
// that key, and whether it improves the ray's hit. Lanes are triangles of a leaf for one ray, or
// rays for one triangle, or pairs of both.
#pragma once

#include "accel/kernels/chord.h"
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

// Corners in the ray's frame: lateral distances from the ray as ShearedTriangle has them, and
// depths without the sign of the direction.
struct Sheared {
    Floats x[3], y[3], z[3];
};

// Edge functions, with the bits of ShearedTriangle.
struct Edges {
    Floats U, V, R, least, most;

    [[gnu::always_inline]] explicit Edges(const Sheared& s)
        : U(s.x[2] * s.y[1] - s.y[2] * s.x[1]), V(s.x[0] * s.y[2] - s.y[0] * s.x[2]),
          R(s.x[1] * s.y[0] - s.y[1] * s.x[0]), least(min(min(U, V), R)), most(max(max(U, V), R)) {}

    // The ray's line meets the triangle, or its edge; NaN never passes later.
    [[gnu::always_inline]] Mask around() const {
        const Floats zero(0.0f);
        return (zero <= least) | (most <= zero);
    }
    [[gnu::always_inline]] Mask certainlyAround() const {
        const Floats zero(0.0f);
        return (zero < least) | (most < zero);
    }
};

// A depth that is off by no more than noise, both times det, is between these; inverse: of det.
template <class Number> Number nearestDepth(Number depth, Number noise, Number inverse) {
    return (depth - noise) * inverse * Number(0.999999f);
}
template <class Number> Number farthestDepth(Number depth, Number noise, Number inverse) {
    return (depth + noise) * inverse * Number(1.000001f);
}

// Where W lines meet W planes of triangles, in float, and how far that may be off.
struct Judged {
    Mask around, certainlyAround;
    Floats depth, noise, det; // depth times det >= 0; not NaN where it is certain

    // May be hits up to zCut.
    [[gnu::always_inline]] unsigned candidates(Floats zCut) const { return bits(mayBeHit(zCut)); }
    [[gnu::always_inline]] Mask mayBeHit(Floats zCut) const {
        const Floats zero(0.0f);
        return around & notGreater(depth, fma(zCut * Floats(1.000001f), det, noise)) &
               notGreater(zero - noise, depth);
    }
    // Are hits, behind the start.
    [[gnu::always_inline]] Mask certain() const { return certainlyAround & (noise < depth); }
    // The same, and in front of zCut, which is 8 units of rounding more than the end of the ray.
    [[gnu::always_inline]] unsigned certain(Floats zCut) const {
        return bits(certain() & (depth + noise < zCut * det * Floats(0.999998f)));
    }
    // The depth is between these.
    Floats nearest(Floats inverse) const { return nearestDepth(depth, noise, inverse); }
    Floats farthest(Floats inverse) const { return farthestDepth(depth, noise, inverse); }
};

// Depth T/det. How far T may be off z det, z
// the canonical depth of a hit, with b the largest lateral distance of a corner from the ray, M the
// largest depth and u = 2^-24: a lateral distance is off by u (4M + 2b) at most (corner relative to
// the ray, slope, product, difference), an edge function by 4b times that and 3u b^2, which is
// u b (16M + 11b); T sums three of them times a depth, with products and sums of its own below
// 24u b^2 M, and z det three more with 12u b^2 M: together below u b M (96M + 102b). Where products
// have no room left below the smallest normal float, each loses 2^-150 more; the least noise is a
// normal number, as others take processors long.
[[gnu::always_inline]] inline Judged judge(const Sheared& s, const Edges& e, Floats sign) {
    const Floats det = (e.U + e.V) + e.R, T = fma(e.R, s.z[2], fma(e.V, s.z[1], e.U * s.z[0]));
    const Floats M = maxAbs(maxAbs(s.z[0], s.z[1]), s.z[2]);
    const Floats b =
        max(max(maxAbs(s.x[0], s.y[0]), maxAbs(s.x[1], s.y[1])), maxAbs(s.x[2], s.y[2]));
    return {e.around(), e.certainlyAround(), flipSign(flipSign(T, det), sign),
            fma(Floats(128 * 0x1p-24f) * b, M * (M + b), Floats(0x1p-120f)), abs(det)};
}

// Pairs of a ray and a triangle, one to a lane.
struct alignas(64) PairColumns {
    float point[3][3][W]; // corner, axis in the ray's order
    float origin[3][W], sign[W], shearX[W], shearY[W], dirX[W], dirY[W], dz[W], lateralError[W];

    PairColumns() = default;
    // The rays of a block, each with a triangle that is still to be set.
    explicit PairColumns(const RayBlock& b) {
        const auto copy = [](const float(&from)[W], float(&to)[W]) {
            Floats::load(from).store(to);
        };
        copy(b.origin[0], origin[0]), copy(b.origin[1], origin[1]), copy(b.origin[2], origin[2]);
        copy(b.sign, sign);
        copy(b.shearX, shearX), copy(b.shearY, shearY);
        copy(b.dirX, dirX), copy(b.dirY, dirY), copy(b.dz, dz);
        copy(b.lateralError, lateralError);
        for (auto& corner : point)
            for (auto& coordinates : corner) Floats(0.0f).store(coordinates);
    }

    // The triangle of ray i.
    void setTriangle(std::uint32_t to, const RayBlock& b, std::uint32_t i, const WideLeaf<W>& leaf,
                     std::uint32_t triangle) {
        const std::byte* const p = reinterpret_cast<const std::byte*>(&leaf);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto* const row = reinterpret_cast<const float*>(p + b.axis[axis][i]);
            for (std::size_t c = 0; c < 3; ++c) point[c][axis][to] = row[leaf.corner[c][triangle]];
        }
    }
    void set(std::uint32_t to, const RayBlock& b, std::uint32_t i, const WideLeaf<W>& leaf,
             std::uint32_t triangle) {
        setTriangle(to, b, i, leaf, triangle);
        for (std::size_t axis = 0; axis < 3; ++axis) origin[axis][to] = b.origin[axis][i];
        sign[to] = b.sign[i];
        shearX[to] = b.shearX[i], shearY[to] = b.shearY[i];
        dirX[to] = b.dirX[i], dirY[to] = b.dirY[i], dz[to] = b.dz[i];
        lateralError[to] = b.lateralError[i];
    }
};

// canonicalKey() of accel/triangle.h, operation by operation. `undecided` gets the lanes whose
// edges have to be asked in double, those that see the triangle edge-on, and those that the
// canonical lateral clamp may change: a key that is inside the triangle's box, padded by a quarter
// of the canonical pad, is none of these.
inline Floats canonicalKeys(const PairColumns& p, unsigned& undecided) {
    const Floats zero(0.0f), one(1.0f), sign = Floats::load(p.sign);
    const Floats Sx = Floats::load(p.shearX) * sign, Sy = Floats::load(p.shearY) * sign;
    const auto rounded = [&](std::size_t c, std::size_t axis) {
        return Floats::load(p.point[c][axis]) - Floats::load(p.origin[axis]);
    };
    const Floats vx[3] = {rounded(0, 0), rounded(1, 0), rounded(2, 0)};
    const Floats vy[3] = {rounded(0, 1), rounded(1, 1), rounded(2, 1)};
    const Floats vz[3] = {rounded(0, 2) * sign, rounded(1, 2) * sign, rounded(2, 2) * sign};
    Floats x[3], y[3];
    for (int c = 0; c < 3; ++c) x[c] = vx[c] - Sx * vz[c], y[c] = vy[c] - Sy * vz[c];
    const Floats U = x[2] * y[1] - y[2] * x[1], V = x[0] * y[2] - y[0] * x[2],
                 R = x[1] * y[0] - y[1] * x[0];
    const Mask inside =
        ((U >= zero) & (V >= zero) & (R >= zero)) | ((U <= zero) & (V <= zero) & (R <= zero));
    const auto least = [](const Floats(&v)[3]) { return min(min(v[0], v[1]), v[2]); };
    const auto most = [](const Floats(&v)[3]) { return max(max(v[0], v[1]), v[2]); };
    const Floats zMin = least(vz), zMax = most(vz);

    // TrianglePlane
    const auto exact = [&](std::size_t c, std::size_t axis) {
        return Doubles(Floats::load(p.point[c][axis])) - Doubles(Floats::load(p.origin[axis]));
    };
    const Doubles exactSign(sign);
    const Doubles x0 = exact(0, 0), y0 = exact(0, 1), z0 = exact(0, 2) * exactSign;
    const Doubles ax = exact(1, 0) - x0, ay = exact(1, 1) - y0, az = exact(1, 2) * exactSign - z0;
    const Doubles bx = exact(2, 0) - x0, by = exact(2, 1) - y0, bz = exact(2, 2) * exactSign - z0;
    const Doubles nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const Doubles dz(Floats::load(p.dz));
    const Doubles along =
        nx * Doubles(Floats::load(p.dirX)) + ny * Doubles(Floats::load(p.dirY)) + nz * dz;
    const Floats plane = (along / ((nx * x0 + ny * y0 + nz * z0) * dz)).toFloats();

    const Mask met = (zMax > zero) & ((zMin > zero) | (plane > zero));
    const Floats nearest = select(zMin > zero, one / zMin, Floats(kInfinityF));
    const Floats key = min(max(plane, one / zMax), nearest);
    const Floats pad = Floats::load(p.lateralError) + Floats::load(p.lateralError);
    const Mask inBox = ((least(vx) - pad) * key <= Sx) & (Sx <= (most(vx) + pad) * key) &
                       ((least(vy) - pad) * key <= Sy) & (Sy <= (most(vy) + pad) * key);
    const unsigned zeros = bits((U == zero) | (V == zero) | (R == zero));
    const unsigned edgeOn = edgeOnLanes(along, edgeOnBound(nx, ny, nz), Floats::load(p.dz));
    undecided = bits(inside & met) & (zeros | edgeOn | ~bits(inBox));
    return select(inside & met, key, zero);
}

// A lane of a block, by slot, and a triangle of a leaf.
struct RayTriangle {
    std::uint32_t slot;
    WideRef leaf;
    std::uint32_t triangle; // number in the leaf
};

// Takes the key as the ray's best one if it counts and is better.
template <Query Q>
bool improve(const WideTree& tree, RayBlock& b, const RayTriangle& p, float key) {
    const std::uint32_t i = p.slot % W;
    if (!(key > 0 && key < b.below[i]) || key < b.key[i]) return false;
    if constexpr (Q == Query::Any) {
        if (key == b.key[i]) return false;
        b.triangle[i] = 0;
    } else {
        const std::uint32_t id = tree.triangleIds[tree.at<WideLeaf<W>>(p.leaf).first + p.triangle];
        if (key == b.key[i] && id > b.triangle[i]) return false;
        b.key[i] = key;
        b.triangle[i] = id;
        b.bestLeaf[i] = p.leaf, b.bestLane[i] = p.triangle;
        b.zCut[i] = ::min(depthCut(key), b.zCut[i]);
        b.depth[i] = depthCut(key) * 0.999998f;
    }
    return true;
}

// Improves the best hits of the pairs' rays, and calls improved(slot) for each that it does.
template <Query Q, class ImprovedFn>
[[gnu::noinline]] void settlePairs(const WideMesh& mesh, const RaySpan& rays, RayBlock* blocks,
                                   std::span<const RayTriangle> pairs, ImprovedFn&& improved) {
    for (; !pairs.empty(); pairs = pairs.subspan(std::min<std::size_t>(W, pairs.size()))) {
        const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(W, pairs.size()));
        const auto leafOf = [&](const RayTriangle& p) -> const WideLeaf<W>& {
            return mesh.tree.at<WideLeaf<W>>(p.leaf);
        };
        PairColumns columns;
        for (std::uint32_t i = 0; i < W; ++i) {
            const RayTriangle& p = pairs[i < count ? i : 0];
            columns.set(i, blocks[p.slot / W], p.slot % W, leafOf(p), p.triangle);
        }
        unsigned undecided = 0;
        alignas(64) float key[W];
        canonicalKeys(columns, undecided).store(key);
        for (undecided &= (1u << count) - 1; undecided != 0; undecided &= undecided - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(undecided));
            const RayTriangle& p = pairs[i];
            const std::uint32_t ray = blocks[p.slot / W].ray[p.slot % W];
            key[i] = exactKey(mesh, rays.org[ray], rays.dir[ray], leafOf(p), p.triangle);
        }
        for (std::uint32_t i = 0; i < count; ++i)
            if (improve<Q>(mesh.tree, blocks[pairs[i].slot / W], pairs[i], key[i]))
                improved(pairs[i].slot);
    }
}

// Keys of the hits that were accepted without one.
[[gnu::noinline]] inline void settleOpen(const WideMesh& mesh, const RaySpan& rays, RayBlock& b) {
    const auto leafOf = [&](std::uint32_t i) -> const WideLeaf<W>& {
        return mesh.tree.at<WideLeaf<W>>(b.bestLeaf[i]);
    };
    const auto forEach = [](unsigned lanes, auto&& body) {
        for (; lanes != 0; lanes &= lanes - 1)
            body(static_cast<std::uint32_t>(std::countr_zero(lanes)));
    };
    PairColumns columns(b);
    forEach(b.open, [&](std::uint32_t i) {
        columns.setTriangle(i, b, i, leafOf(i), b.bestLane[i]);
        b.triangle[i] = mesh.tree.triangleIds[leafOf(i).first + b.bestLane[i]];
    });
    unsigned undecided = 0;
    const Floats keys = canonicalKeys(columns, undecided);
    select(maskOf(b.open), keys, Floats::load(b.key)).store(b.key);
    forEach(undecided & b.open, [&](std::uint32_t i) {
        b.key[i] = exactKey(mesh, rays.org[b.ray[i]], rays.dir[b.ray[i]], leafOf(i), b.bestLane[i]);
    });
    b.open = 0;
}

LANES_END
