// Interval: the part of a line that is inside a convex solid, with the solid's parts at both ends.
// A capped cylinder is slab * tube, a cube three slabs: as the pieces meet in one comparison of t,
// there is no gap at a rim or an edge. Knows nothing about rays or transforms.
#pragma once

#include "base/math.h"

#include <cstdint>

// A crossing of a surface: line parameter and part of the shape.
struct Root {
    double t = 0;
    std::uint32_t part = 0;
};

struct Interval {
    Root enter{-kInfinity, 0}, exit{kInfinity, 0}; // the whole line
    bool isEmpty() const { return !(enter.t <= exit.t); }
    static Interval empty() { return {{kInfinity, 0}, {-kInfinity, 0}}; }
    // The line is inside everywhere, or nowhere.
    static Interval all(bool inside) { return inside ? Interval{} : empty(); }
};

// At equal t the part of `a` is taken.
inline Interval intersection(const Interval& a, const Interval& b) {
    return {a.enter.t >= b.enter.t ? a.enter : b.enter, a.exit.t <= b.exit.t ? a.exit : b.exit};
}

// Where lo <= o + t d <= hi.
inline Interval slab(double o, double d, double lo, double hi, std::uint32_t loPart,
                     std::uint32_t hiPart) {
    if (d == 0) return Interval::all(lo <= o && o <= hi);
    const Root atLo{(lo - o) / d, loPart}, atHi{(hi - o) / d, hiPart};
    return d > 0 ? Interval{atLo, atHi} : Interval{atHi, atLo};
}

// Where |o + t d| <= radius in two or three dimensions, given d.d > 0, o.d, o.o and the squared
// distance `ll` of the line from the centre. With ll from the perpendicular vector o - (o.d/d.d) d
// nothing cancels for far origins (Ray Tracing Gems, chapter 7); the end near the origin comes from
// the product of the roots, so it keeps its relative accuracy.
inline Interval insideRound(double dd, double od, double oo, double ll, double radius,
                            std::uint32_t part) {
    const double rr = radius * radius;
    if (!(radius > 0 && ll <= rr)) return Interval::empty();
    const double middle = -od / dd, half = std::sqrt((rr - ll) / dd);
    const double far = middle + std::copysign(half, middle);
    const double near = far != 0 ? (oo - rr) / (dd * far) : 0;
    return near < far ? Interval{{near, part}, {far, part}} : Interval{{far, part}, {near, part}};
}
