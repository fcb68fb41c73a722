// Texture coordinates of the points that W hits are pulled onto: what the describe() of each shape
// says of them, in the same order.
#pragma once

#include "simd/double_double_lanes.h"
#include "accel/kernels/still_numbers.h"
#include "accel/kernels/still_points.h"
#include "simd/vectors3.h"
#include "base/math.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>

LANES_BEGIN

struct TextureCoordinates {
    Doubles u, v;
};

// Of the direction (x, y), from -1/2 to 1/2. On the axis of a sphere the numbers may be so small
// that angleOf() scales them.
inline Doubles turnsOf(const Doubles& y, const Doubles& x) {
    const Doubles larger = max(abs(x), abs(y));
    Doubles angle = anglesOf(y, x);
    if (unsigned small = less(Doubles(0.0), larger) & less(larger, Doubles(0x1p-900)); small != 0) {
        alignas(64) double xs[W], ys[W], angles[W];
        x.store(xs), y.store(ys), angle.store(angles);
        for (; small != 0; small &= small - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(small));
            angles[i] = exact::atan2(ys[i], xs[i]);
        }
        angle = Doubles::load(angles);
    }
    return angle * Doubles(kInvTwoPi);
}

inline Doubles middled(const Doubles& x) { return Doubles(0.5) + x; }

inline TextureCoordinates uvOnSphere(const Doubles3& n) {
    const Doubles around = sqrt(n.x * n.x + n.y * n.y);
    return {middled(turnsOf(n.y, n.x)), middled(anglesOf(n.z, around) * Doubles(kInvPi))};
}

// Of sides of cylinders and cones.
inline TextureCoordinates uvOnSide(const Local& at) {
    return {middled(turnsOf(at.normal.y, at.normal.x)), middled(Doubles(0.5) * at.p.z)};
}

// `end`: as onCap() takes it.
inline TextureCoordinates uvOnCap(const Doubles3& p, const Doubles3& end) {
    const Doubles half(0.5);
    return {middled(half * end.z * p.x / end.x), middled(half * p.y / end.x)};
}

// The face's axes of cube.cpp: x to the right on faces along y and z, y on those along x.
inline TextureCoordinates uvOnCube(const Local& at) {
    const Doubles3 &p = at.p, &n = at.normal;
    const Doubles zero(0.0), half(0.5);
    const Mask isX = zero < abs(n.x), isZ = zero < abs(n.z);
    const Doubles right = select(isX, n.x * p.y, select(isZ, n.z * p.x, (zero - n.y) * p.x));
    return {middled(half * right), middled(half * select(isZ, p.y, p.z))};
}

inline TextureCoordinates uvOnDisk(const StillNumbers& shape, const Doubles3& p) {
    const Doubles side = Doubles(2.0) * shape(Radius);
    return {middled(p.x / side), middled(p.y / side)};
}

// Plane::describe()
inline TextureCoordinates uvOnCorners(const StillNumbers& shape, const Doubles3& p) {
    struct Flat {
        Doubles x, y;
    };
    const auto cross2 = [](const Flat& a, const Flat& b) { return a.x * b.y - a.y * b.x; };
    const auto dot2 = [](const Flat& a, const Flat& b) { return a.x * b.x + a.y * b.y; };
    const Doubles zero(0.0), one(1.0), two(2.0);
    const auto onAxis = [&](Number axis) {
        const Doubles number = shape(axis);
        return select(number < one, p.x, select(number < two, p.y, p.z));
    };
    const Flat e{shape(AlongUX), shape(AlongUY)}, f{shape(AlongVX), shape(AlongVY)},
        g{shape(BentX), shape(BentY)},
        h{onAxis(AxisX) - shape(OriginX), onAxis(AxisY) - shape(OriginY)};
    const Doubles k2 = cross2(g, f), k1 = cross2(e, f) - cross2(g, h),
                  k0 = Doubles(-0.0) - cross2(e, h);
    const Doubles jacobian = sqrt(max(k1 * k1 - Doubles(4.0) * k2 * k0, zero));
    const Doubles raw = select(maskOf(atMost(zero, k1)), Doubles(-2.0) * k0 / (k1 + jacobian),
                               (jacobian - k1) / (two * k2));
    const Doubles v = min(max(raw, zero), one);
    const Flat along{e.x + g.x * v, e.y + g.y * v}, rest{h.x - f.x * v, h.y - f.y * v};
    return {min(max(dot2(rest, along) / dot2(along, along), zero), one), v};
}

// `face` is what pulledOnto() takes.
inline TextureCoordinates uvOf(Kind kind, const StillNumbers& shape, const Local& at,
                               const Doubles3& face) {
    switch (kind) {
    case Kind::Sphere: return uvOnSphere(at.normal);
    case Kind::Cylinder:
    case Kind::Cone: return uvOnSide(at);
    case Kind::Cap: return uvOnCap(at.p, face);
    case Kind::Cube: return uvOnCube(at);
    case Kind::Disk: return uvOnDisk(shape, at.p);
    case Kind::Corners: return uvOnCorners(shape, at.p);
    default: return {at.p.x, at.p.y};
    }
}

LANES_END
