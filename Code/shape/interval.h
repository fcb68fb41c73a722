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

// Where |o + t d| <= radius in two or three dimensions, given d.d > 0, o.d and the squared distance
// `ll` of the line from the centre. With ll from the perpendicular vector o - (o.d / d.d) d nothing
// cancels for far origins (Ray Tracing Gems, chapter 7), and the ends are off by the rounding of
// the middle and the half only: 2^-52 of the distance to the centre.
inline Interval insideRound(double dd, double od, double ll, double radius, std::uint32_t part) {
    const double rr = radius * radius;
    if (!(radius > 0 && ll <= rr)) return Interval::empty();
    const double middle = -od / dd, half = std::sqrt((rr - ll) / dd);
    return {{middle - half, part}, {middle + half, part}};
}
