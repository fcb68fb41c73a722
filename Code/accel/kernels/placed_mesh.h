// A ray in the tree of one placed mesh: the steps of queue.h with room for what is not known
// exactly. A box is entered when the ray passes it within the room that the triangles in it ask
// for, and a triangle may be met when moved corners could be.
#pragma once

#include "accel/kernels/placed.h"
#include "accel/kernels/wide_tree.h"
#include "accel/ray_setup.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

struct MeshRay {
    // Boxes in the tree of a mesh.
    float r[3], nearOffset[3], farOffset[3];
    std::uint32_t nearPlane[3]; // where in a node, in bytes
    float zCut, depthPerSide;
    const std::byte* base;
    const float* longestSide;
    WideRef at; // the leaf of the candidates
    // Triangles: the origin in the order lateral x, lateral y, depth.
    float origin[3];
    std::uint32_t axis[3]; // where in a leaf, in bytes
    float shearX, shearY;  // the slopes, for depths without the sign of the direction
    float sign, lateralError;
    unsigned candidates; // of the leaf
    const std::uint32_t* triangleIds;
    const Vec3d* exactPoints;

    void enter(const TreeVisit& visit) {
        const RaySetup& ray = *visit.setup;
        constexpr std::uint32_t kRow = W * 4;
        for (std::size_t i = 0; i < 3; ++i) {
            r[i] = ray.r[i];
            nearOffset[i] = ray.nearOffset[i], farOffset[i] = ray.farOffset[i];
            nearPlane[i] = (2 * static_cast<std::uint32_t>(i) + (ray.r[i] < 0)) * kRow;
        }
        const std::size_t order[3] = {ray.kx, ray.ky, ray.k};
        for (std::size_t i = 0; i < 3; ++i) {
            origin[i] = ray.org[order[i]];
            axis[i] = static_cast<std::uint32_t>(order[i]) * kRow;
        }
        sign = ray.sign;
        shearX = ray.Sx * ray.sign, shearY = ray.Sy * ray.sign;
        zCut = visit.zCut;
        depthPerSide = visit.depthPerSide;
        lateralError = visit.lateralError;
        longestSide = visit.longestSide;
        base = visit.tree->base();
        triangleIds = visit.tree->triangleIds.data();
        exactPoints = visit.exactPoints;
    }

    // TreeRay's enters() of shape/instance_filter.h for W boxes, with the room that the node needs.
    // Returns the children entered, and the depths where.
    [[gnu::always_inline]] unsigned entered(WideRef ref, Floats& entry) const {
        const std::byte* const node = base + byteOffset(ref);
        const Floats room(longestSide[ref >> 2] * depthPerSide);
        entry = Floats(0.0f) - room;
        Floats exit = Floats(zCut) + room;
        for (std::size_t i = 0; i < 3; ++i) {
            const Floats inverse(r[i]);
            const Floats front = Floats::load(node + nearPlane[i]);
            const Floats behind = Floats::load(node + (nearPlane[i] ^ (W * 4)));
            entry = max(fma(front, inverse, Floats(nearOffset[i])), entry);
            exit = min(fma(behind, inverse, Floats(farOffset[i])), exit);
        }
        const unsigned hit = bits(entry <= exit);
        entry = max(entry - room, Floats(0.0f));
        return hit;
    }
    const WideRef* children(WideRef ref) const {
        return reinterpret_cast<const WideRef*>(base + byteOffset(ref) + std::ptrdiff_t{6} * W * 4);
    }

    // TreeRay::mayMeet() for W triangles, and whether they are at depths where a hit counts.
    void findCandidates(WideRef ref) {
        at = ref;
        const std::byte* const p = base + byteOffset(ref);
        const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(p);
        const Floats x = Floats::load(p + axis[0]) - Floats(origin[0]);
        const Floats y = Floats::load(p + axis[1]) - Floats(origin[1]);
        const Floats z = Floats::load(p + axis[2]) - Floats(origin[2]);
        const Floats xs = x - Floats(shearX) * z, ys = y - Floats(shearY) * z;
        const Floats depth = flipSign(z, Floats(sign)), size = max(abs(xs), abs(ys));
        const Ints i0 = Ints::bytes(leaf.corner[0]), i1 = Ints::bytes(leaf.corner[1]),
                   i2 = Ints::bytes(leaf.corner[2]);
        const Floats x0 = permute(xs, i0), x1 = permute(xs, i1), x2 = permute(xs, i2);
        const Floats y0 = permute(ys, i0), y1 = permute(ys, i1), y2 = permute(ys, i2);
        const Floats z0 = permute(depth, i0), z1 = permute(depth, i1), z2 = permute(depth, i2);
        const Floats U = x2 * y1 - y2 * x1, V = x0 * y2 - y0 * x2, R = x1 * y0 - y1 * x0;
        const Floats most = max(max(U, V), R), least = min(min(U, V), R);
        const Floats farthest = max(max(permute(size, i0), permute(size, i1)), permute(size, i2));
        const Floats error = Floats(5 * lateralError) * farthest;
        const Mask outside = (least < Floats(0.0f) - error) & (error < most);
        const float room = longestSide[at >> 2] * depthPerSide + lateralError;
        const Mask hidden =
            (Floats(zCut + room) < min(min(z0, z1), z2)) | (max(max(z0, z1), z2) < Floats(-room));
        candidates = ~bits(outside | hidden) & ((1u << leaf.count) - 1);
    }

    // fn(triangle, its exact corners)
    template <class Fn> void forEachCandidate(Fn&& fn) const {
        const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(base + byteOffset(at));
        const Vec3d* const points = exactPoints + (at >> 2) * TreeVisit::kPerLine;
        for (unsigned rest = candidates; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
            fn(triangleIds[leaf.first + i], points[leaf.corner[0][i]], points[leaf.corner[1][i]],
               points[leaf.corner[2][i]]);
        }
    }
};

LANES_END
