// The formulas of coneFromSquare(), as those of the disk are in disk_lanes.h.
#pragma once

#include "base/vec.h"
#include "render/waves/circle_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>

LANES_BEGIN

// Samples of the lamp, one of each point: places on it, and the ways there.
struct LampRow : SquareRow {
    Three toLight;
    Floats distance2, distance;
};

// x and y of the direction; its z is zOnCone(). Not for cones that are too narrow for floats.
inline void placeOnCone(SquareRow& row, const Doubles& oneMinusCos, unsigned& unsure) {
    const Doubles h = oneMinusCos * Doubles(Floats::load(row.u));
    const Doubles sine = sqrt(max(h * (Doubles(2.0) - h), Doubles(0.0)));
    const OnCircle at = nearlyOnCircle(Floats::load(row.v), unsure);
    surelyRounded(sine * at.x, unsure).store(row.x);
    surelyRounded(sine * at.y, unsure).store(row.y);
}
inline Floats zOnCone(const SquareRow& row, const Doubles& oneMinusCos) {
    return (Doubles(1.0) - oneMinusCos * Doubles(Floats::load(row.u))).toFloats();
}
inline void placeSurelyOnCone(SquareRow& row, const double* oneMinusCos, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
        const Vec3 way = coneFromSquare(Vec2{row.u[i], row.v[i]}, oneMinusCos[i]);
        row.x[i] = way.x, row.y[i] = way.y;
    }
}
constexpr double kNarrowestCone = 0x1p-60;

LANES_END
