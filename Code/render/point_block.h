// PointBlock: sixteen points of a wave, component by component, as lanes want them. ShadedPoint is
// one of them in one piece.
#pragma once

#include "base/surface_block.h"

#include <cstddef>

struct alignas(64) PointBlock : SurfaceBlock {
    alignas(64) Lane toEye[3]; // not right behind the bits
    Lane n[3];                 // eye.n
    Lane litN[3];              // lit.n of those that are lit apart
    // One bit for each point.
    unsigned front = 0;    // the ray came from the outside
    unsigned litApart = 0; // seen from the inside, lit on the outside

    // Are its normals as they are seen, or turned around?
    bool isFront(std::size_t i) const { return (front >> i & 1) != 0; }
    bool isLitApart(std::size_t i) const { return (litApart >> i & 1) != 0; }
};
