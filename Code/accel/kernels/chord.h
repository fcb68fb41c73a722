// Triangles that W rays see edge-on: which rays may, where they meet one, and how near it is.
#pragma once

#include "accel/triangle.h"
#include "base/vec.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

#include <limits>

LANES_BEGIN

// TrianglePlane::isEdgeOn() compares with a length: a direction is at most sqrt(3) dz long, and the
// bound is 2^-10 larger than it has to be. Squares are in double, which floats of any size neither
// overflow nor underflow, and no root is taken.

// For triangles with these normals.
[[gnu::always_inline]] inline Doubles edgeOnBound(const Doubles& nx, const Doubles& ny,
                                                  const Doubles& nz) {
    constexpr double kPerSteep = 1.7338 / TrianglePlane::kSteep;
    return ((nx * nx + ny * ny) + nz * nz) * Doubles(kPerSteep * kPerSteep);
}
// Also where there is a NaN.
[[gnu::always_inline]] inline unsigned edgeOnLanes(const Doubles& along, const Doubles& bound,
                                                   Floats dz) {
    const Doubles depth(dz);
    return ~less(bound * (depth * depth), along * along);
}

// Barycentrics of W hits.

struct Weights {
    Floats u, v;
};

// barycentrics() of shape/triangle_queries.h, operation by operation, from the x and y of
// ShearedTriangle.
inline Weights barycentrics(const Floats (&x)[3], const Floats (&y)[3]) {
    const auto edge = [&](int a, int b) {
        return Doubles(x[a]) * Doubles(y[b]) - Doubles(y[a]) * Doubles(x[b]);
    };
    const Doubles e0 = edge(2, 1), e1 = edge(0, 2), e2 = edge(1, 0);
    const Doubles sum = e0 + e1 + e2;
    return {(e1 / sum).toFloats(), (e2 / sum).toFloats()};
}

// TrianglePlane::keyInChord(), operation by operation, for rays that see one triangle edge-on: a
// floor, up to the horizon, fills many packets with them.

// `v`: the corners relative to the origin of all rays, `dir`: theirs, both as in RaySetup.
inline Floats keysInChord(const Vec3d (&v)[3], const Doubles3& dir, Floats key) {
    const Vec3d normal = cross(v[1] - v[0], v[2] - v[0]);
    const Doubles3 n = forAll(normal);
    const Doubles along = dot(n, dir), length2 = dot(dir, dir);
    constexpr double kSteep2 = TrianglePlane::kSteep * TrianglePlane::kSteep;
    const Mask isEdgeOn =
        maskOf(~atMost(Doubles(dot(normal, normal)) * length2, Doubles(kSteep2) * (along * along)));

    const Doubles3 crossing = cross(dir, n), across = crossing / sqrt(dot(crossing, crossing));
    const Doubles zPerDot = dir.z / length2;
    const double size = ::max(::max(maxAbs(v[0]), maxAbs(v[1])), maxAbs(v[2]));
    const Doubles room(TrianglePlane::kChordRoom * size);
    const Doubles z[3] = {dot(forAll(v[0]), dir) * zPerDot, dot(forAll(v[1]), dir) * zPerDot,
                          dot(forAll(v[2]), dir) * zPerDot};
    const Doubles beside[3] = {dot(forAll(v[0]), across), dot(forAll(v[1]), across),
                               dot(forAll(v[2]), across)};
    Doubles nearest(std::numeric_limits<double>::infinity()), farthest = Doubles(0.0) - nearest;
    const auto extend = [&](unsigned lanes, const Doubles& depth) {
        const Mask which = maskOf(lanes);
        nearest = select(which, min(nearest, depth - room), nearest);
        farthest = select(which, max(farthest, depth + room), farthest);
    };
    for (int i = 0; i < 3; ++i) {
        extend(atMost(abs(beside[i]), room), z[i]);
        const int j = (i + 1) % 3;
        for (const Doubles& border : {Doubles(0.0) - room, room})
            extend(less(beside[i], border) ^ less(beside[j], border),
                   z[i] + (z[j] - z[i]) * ((border - beside[i]) / (beside[j] - beside[i])));
    }
    const Doubles zero(0.0), one(1.0);
    const Mask isInFront = zero < farthest;
    const Floats atLeast = max(key, (one / farthest).toFloats());
    const Floats inChord =
        select(zero < nearest, min(atLeast, (one / nearest).toFloats()), atLeast);
    return select(isEdgeOn, select(isInFront, inChord, Floats(0.0f)), key);
}

LANES_END
