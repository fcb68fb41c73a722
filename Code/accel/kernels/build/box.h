// Boxes while the builder works on them, lane = axis. One builder does for all machines: boxes in
// registers of AVX2 made the tree of 980,000 triangles no sooner (medians of four, in turn).
#pragma once

#include "accel/four.h"
#include "accel/prim_box.h"

#include <limits>

namespace kernels::build {

struct Box {
    Four lo, negHi;
    static Box load(const PrimBox& p) { return {loadFour(p.lo.data()), loadFour(p.negHi.data())}; }
    static Box ofPoint(Four p) { return {p, -p}; }
    static Box empty() {
        constexpr float kHuge = std::numeric_limits<float>::max();
        return {allFour(kHuge), allFour(kHuge)};
    }
    void store(PrimBox& p) const { storeFour(lo, p.lo.data()), storeFour(negHi, p.negHi.data()); }
    void extend(const Box& b) { lo = least(lo, b.lo), negHi = least(negHi, b.negHi); }
    Four twiceCentre() const { return lo - negHi; }

    // Products of two sides: xy, yz, zx. Both signs of a size do.
    Four sideProducts() const {
        const Four size = lo + negHi;
        return size * __builtin_shufflevector(size, size, 1, 2, 0, 3);
    }
    float halfArea() const {
        const Four p = sideProducts();
        return p[0] + p[1] + p[2];
    }
};

// Returns half the areas of three boxes, in the order of halfArea().
inline Four halfAreas(const Box& a, const Box& b, const Box& c) {
    const Four p = a.sideProducts(), q = b.sideProducts(), r = c.sideProducts();
    const Four low = __builtin_shufflevector(p, q, 0, 4, 1, 5);
    const Four high = __builtin_shufflevector(p, q, 2, 6, 3, 7);
    const Four xy = __builtin_shufflevector(low, r, 0, 1, 4, 4);
    const Four yz = __builtin_shufflevector(low, r, 2, 3, 5, 5);
    const Four zx = __builtin_shufflevector(high, r, 0, 1, 6, 6);
    return xy + yz + zx;
}

} // namespace kernels::build
