// Axis-aligned boxes. The default box is empty (lo = +inf, hi = -inf) and neutral for extend().
// Knows nothing about what is inside.
#pragma once

#include "base/math.h"
#include "base/vec.h"

template <class T> struct BoundsT {
    static constexpr T kInf = std::numeric_limits<T>::infinity();
    Vec3T<T> lo{kInf, kInf, kInf}, hi{-kInf, -kInf, -kInf};

    constexpr bool operator==(const BoundsT&) const = default;

    // NaN coordinates are ignored: they compare false and the box keeps its side.
    constexpr void extend(Vec3T<T> p) {
        lo = {min(p.x, lo.x), min(p.y, lo.y), min(p.z, lo.z)};
        hi = {max(p.x, hi.x), max(p.y, hi.y), max(p.z, hi.z)};
    }
    constexpr void extend(const BoundsT& box) {
        lo = {min(box.lo.x, lo.x), min(box.lo.y, lo.y), min(box.lo.z, lo.z)};
        hi = {max(box.hi.x, hi.x), max(box.hi.y, hi.y), max(box.hi.z, hi.z)};
    }

    // Empty means that no point is inside; a flat box is not empty.
    constexpr bool isEmpty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    constexpr bool isFinite() const {
        return maxAbs(lo) < kInf && maxAbs(hi) < kInf; // false for NaN as well
    }
    constexpr Vec3T<T> size() const { return hi - lo; }
    // Halves first: a box of the largest numbers has a finite centre.
    constexpr Vec3T<T> centre() const { return lo * T(0.5) + hi * T(0.5); }
    // Half the surface, what the surface area heuristic needs; 0 for an empty box.
    constexpr T halfArea() const {
        if (isEmpty()) return 0;
        const Vec3T<T> d = size();
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
    // The axis (0, 1, 2) of the longest side, the lowest of equal ones.
    constexpr int longestAxis() const {
        const Vec3T<T> d = size();
        if (d.x >= d.y && d.x >= d.z) return 0;
        return d.y >= d.z ? 1 : 2;
    }
    // Corner 0..7: bit 0 picks hi.x, bit 1 hi.y, bit 2 hi.z.
    constexpr Vec3T<T> corner(int index) const {
        return {index & 1 ? hi.x : lo.x, index & 2 ? hi.y : lo.y, index & 4 ? hi.z : lo.z};
    }
    // Closed: the sides belong to the box.
    constexpr bool contains(Vec3T<T> p) const {
        return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z &&
               p.z <= hi.z;
    }
    // An empty box is inside every box.
    constexpr bool contains(const BoundsT& box) const {
        return box.isEmpty() || (contains(box.lo) && contains(box.hi));
    }
    constexpr bool overlaps(const BoundsT& box) const {
        return lo.x <= box.hi.x && box.lo.x <= hi.x && lo.y <= box.hi.y && box.lo.y <= hi.y &&
               lo.z <= box.hi.z && box.lo.z <= hi.z;
    }
    // Moves every side outwards by a distance >= 0; an empty box stays empty.
    constexpr BoundsT padded(T distance) const {
        if (isEmpty()) return *this;
        const Vec3T<T> d{distance, distance, distance};
        return {lo - d, hi + d};
    }
};

using Bounds = BoundsT<float>;
using BoundsD = BoundsT<double>;

template <class T> constexpr BoundsT<T> merge(BoundsT<T> a, const BoundsT<T>& b) {
    a.extend(b);
    return a;
}
// What both boxes share, may be empty.
template <class T> constexpr BoundsT<T> intersection(const BoundsT<T>& a, const BoundsT<T>& b) {
    return {{max(a.lo.x, b.lo.x), max(a.lo.y, b.lo.y), max(a.lo.z, b.lo.z)},
            {min(a.hi.x, b.hi.x), min(a.hi.y, b.hi.y), min(a.hi.z, b.hi.z)}};
}
constexpr BoundsD toDouble(const Bounds& box) { return {toDouble(box.lo), toDouble(box.hi)}; }
// The smallest float box around a double box.
constexpr Bounds outward(const BoundsD& box) {
    return {{floatBelow(box.lo.x), floatBelow(box.lo.y), floatBelow(box.lo.z)},
            {floatAbove(box.hi.x), floatAbove(box.hi.y), floatAbove(box.hi.z)}};
}
