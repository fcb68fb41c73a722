// The points of surfaces that W hits are pulled onto, in the object spaces of their shapes: what
// the describe() of each shape does, in the same order.
#pragma once

#include "accel/kernels/still_numbers.h"
#include "accel/kernels/surface_columns.h"
#include "simd/vectors3.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

struct Local {
    Doubles3 p, normal;
};

inline Doubles lesser(const Doubles& a, const Doubles& b) { return select(a < b, a, b); }
// clamp() to +-limit, where that is not 0.
inline Doubles within(const Doubles& limit, const Doubles& x) {
    return lesser(max(x, Doubles(0.0) - limit), limit);
}

// AnalyticShape::Clearance::inset() along an axis. `clearance`: how far, in the world, the origin
// of a ray may be from the point.
inline Doubles inset(const StillNumbers& shape, std::size_t axis, const Doubles& clearance) {
    const std::size_t row = ObjectFromWorld + 4 * axis;
    const Doubles3 steep{shape(row), shape(row + 1), shape(row + 2)};
    return clearance * sqrt(dot(steep, steep));
}
inline Doubles limitOf(const Doubles& inset) { return Doubles(1.0) - lesser(inset, Doubles(0.5)); }

// The direction from the z axis; +x on it.
struct Around {
    Doubles c, s;
};
inline Around aroundAxis(const Doubles3& met) {
    const Doubles distance = sqrt(met.x * met.x + met.y * met.y), zero(0.0);
    const Mask isOff = zero < distance;
    return {select(isOff, met.x / distance, Doubles(1.0)), select(isOff, met.y / distance, zero)};
}

inline Local onSphere(const StillNumbers& shape, const Doubles3& met) {
    const Doubles distance = sqrt(dot(met, met)), zero(0.0);
    const Doubles3 n = select(zero < distance, met / distance, Doubles3{zero, zero, Doubles(1.0)});
    return {n * shape(Radius), n};
}

inline Local onCylinder(const StillNumbers& shape, const Doubles3& met, const Doubles& clearance) {
    const auto [c, s] = aroundAxis(met);
    const Doubles limit = limitOf(inset(shape, 2, clearance)), radius = shape(Radius);
    return {{c * radius, s * radius, within(limit, met.z)}, {c, s, Doubles(0.0)}};
}

inline Local onCone(const StillNumbers& shape, const Doubles3& met, const Doubles& clearance) {
    const auto [c, s] = aroundAxis(met);
    const Doubles zero(0.0), half(0.5), slope = shape(Slope);
    const Doubles insetX = inset(shape, 0, clearance), insetY = inset(shape, 1, clearance);
    const Doubles around = sqrt(insetX * insetX + insetY * insetY);
    const Doubles z = within(limitOf(inset(shape, 2, clearance)), met.z);
    const Doubles w = shape(NarrowRadius) + slope * (z - shape(NarrowZ));
    const Doubles3 normal{c, s, Doubles(-0.0) - slope};

    const Doubles widest = shape(Widest) * half;
    const Doubles3 steep{row(shape, ObjectFromWorld, 4, normal),
                         row(shape, ObjectFromWorld + 1, 4, normal),
                         row(shape, ObjectFromWorld + 2, 4, normal)};
    const Doubles inwards = (half * clearance) * sqrt(dot(steep, steep));
    const Doubles aside = Doubles(0.75) * around;
    const Doubles least = select((zero < around) & (w < widest),
                                 lesser((Doubles(2.0) * (aside * aside)) / inwards, widest), zero);
    const Mask isNarrow = w < least;
    const Doubles wide = select(isNarrow, least, w);
    const Doubles down = shape(NarrowZ) + (least - shape(NarrowRadius)) / slope;
    return {{c * wide, s * wide, select(isNarrow, down, z)}, normal};
}

// cap(); of the end: its radius, the side's slope, and +-1.
inline Local onCap(const StillNumbers& shape, const Doubles3& met, const Doubles3& end,
                   const Doubles& clearance) {
    const Doubles insetX = inset(shape, 0, clearance), insetY = inset(shape, 1, clearance);
    const Doubles aside = sqrt(insetX * insetX + insetY * insetY);
    const Doubles in = aside + end.y * inset(shape, 2, clearance), zero(0.0);
    const Doubles limit = end.x - lesser(in, end.x * Doubles(0.5));
    const Doubles around = sqrt(met.x * met.x + met.y * met.y);
    const Doubles factor = select(limit < around, limit / around, Doubles(1.0));
    return {{met.x * factor, met.y * factor, end.z}, {zero, zero, end.z}};
}

// normal: of the face that is met.
inline Local onCube(const StillNumbers& shape, const Doubles3& met, const Doubles3& normal,
                    const Doubles& clearance) {
    const auto along = [&](std::size_t axis, const Doubles& x, const Doubles& n) {
        const Doubles inFace = within(limitOf(inset(shape, axis, clearance)), x);
        return select(Doubles(0.0) < abs(n), n, inFace);
    };
    return {{along(0, met.x, normal.x), along(1, met.y, normal.y), along(2, met.z, normal.z)},
            normal};
}

// Planes without end, too.
inline Local onDisk(const Doubles3& met) {
    const Doubles zero(0.0);
    return {{met.x, met.y, zero}, {zero, zero, Doubles(1.0)}};
}

inline Local onCorners(const StillNumbers& shape, const Doubles3& met) {
    const Doubles3 n{shape(NormalX), shape(NormalY), shape(NormalZ)};
    const Doubles3 centre{shape(CentreX), shape(CentreY), shape(CentreZ)};
    return {met + n * (dot(n, centre - met) / dot(n, n)), n};
}

// `face` is the normal of a cube's face; of caps it is what capsMet() says.
inline Local pulledOnto(Kind kind, const StillNumbers& shape, const Doubles3& met,
                        const Doubles3& face, const Doubles& clearance) {
    switch (kind) {
    case Kind::Sphere: return onSphere(shape, met);
    case Kind::Cylinder: return onCylinder(shape, met, clearance);
    case Kind::Cone: return onCone(shape, met, clearance);
    case Kind::Cube: return onCube(shape, met, face, clearance);
    case Kind::Corners: return onCorners(shape, met);
    case Kind::Cap: return onCap(shape, met, face, clearance);
    default: return onDisk(met);
    }
}

LANES_END
