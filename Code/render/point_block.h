// PointBlock: sixteen points of a wave, component by component, as lanes want them. ShadedPoint is
// one of them in one piece.
#pragma once

#include "base/surface_block.h"

#include <cstddef>
#include <iterator>

struct alignas(64) PointBlock : SurfaceBlock {
    alignas(64) Lane toEye[3]; // not right behind the bits
    Lane n[3];                 // eye.n
    Lane litN[3];              // lit.n of those that are lit apart
    // One bit for each point.
    unsigned front = 0;    // the ray came from the outside
    unsigned litApart = 0; // seen from the inside, lit on the outside

    // Place i becomes point `from` of another block.
    void take(std::size_t i, const PointBlock& other, std::size_t from) {
        const auto copy = [&](const auto& source, auto& to) {
            for (std::size_t axis = 0; axis < std::size(to); ++axis)
                to[axis][i] = source[axis][from];
        };
        copy(other.p, p), copy(other.ng, ng), copy(other.uv, uv);
        copy(other.toEye, toEye), copy(other.n, n);
        error[i] = other.error[from], rayError[i] = other.rayError[from];
        material[i] = other.material[from], object[i] = other.object[from];
        const auto bit = [&](unsigned bits) { return (bits >> from & 1) << i; };
        front |= bit(other.front), litApart |= bit(other.litApart), curved |= bit(other.curved);
        if (other.isCurved(from)) copy(other.ns, ns), copy(other.lift, lift);
        if (other.isLitApart(from)) copy(other.litN, litN);
    }
    // Are its normals as they are seen, or turned around?
    bool isFront(std::size_t i) const { return (front >> i & 1) != 0; }
    bool isLitApart(std::size_t i) const { return (litApart >> i & 1) != 0; }
};
