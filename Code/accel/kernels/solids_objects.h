// The rays of a packet in the object space of a shape, and what they meet of it.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "base/transform.h"
#include "base/math.h"
#include "base/motion.h"
#include "base/ray.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

LANES_BEGIN

struct ObjectRays {
    Doubles ox, oy, oz, dx, dy, dz;

    // Lanes that AnalyticShape::rootsOf() looks at: neither zero nor without end.
    unsigned usable() const {
        const Doubles most(std::numeric_limits<double>::max());
        const Doubles dd = (dx * dx + dy * dy) + dz * dz;
        return less(Doubles(0.0), dd) & atMost(dd, most) &
               atMost((ox * ox + oy * oy) + oz * oz, most);
    }
};

// One map in all lanes, or one in each.
struct SameMap {
    const AffineRows& rows;
    double operator()(std::size_t i) const { return rows[i]; }
};
struct MapLanes {
    const double (*rows)[W];
    Doubles operator()(std::size_t i) const { return Doubles::load(rows[i]); }
};
// Of what moves without turning, at the times of some of W rays: one offset in each.
struct DriftLanes {
    DriftLanes(const AffineRows& map, const Drift& drift, const RaySpan& rays,
               const std::uint32_t (&ray)[W], unsigned lanes)
        : rows(map) {
        if (drift.legs().size() == 2) {
            fromOneKeyToTheOther(drift, rays, ray);
            return;
        }
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
            const Vec3d at = drift.offsetAt(static_cast<double>(rays.time[ray[i]]));
            offset[0][i] = at.x, offset[1][i] = at.y, offset[2][i] = at.z;
        }
    }
    // Drift::offsetAt(): the time is the place within the leg, but at its end.
    void fromOneKeyToTheOther(const Drift& drift, const RaySpan& rays,
                              const std::uint32_t (&ray)[W]) {
        alignas(64) double times[W];
        for (std::size_t i = 0; i < W; ++i)
            times[i] = clamp(static_cast<double>(rays.time[ray[i]]), 0.0, 1.0);
        const Doubles time = Doubles::load(times), one(1.0), minus(-0.0);
        const Mask isEnd = maskOf(atMost(one, time));
        const Doubles s = select(isEnd, time - one, time);
        const Drift::Leg &first = drift.legs()[0], &last = drift.legs()[1];
        const auto moved = [&](std::size_t axis) {
            return minus - select(isEnd, Doubles(last.step[axis]), Doubles(first.step[axis])) * s;
        };
        const Doubles x = moved(0), y = moved(1), z = moved(2);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double* const m = &rows[4 * axis];
            const Doubles from =
                select(isEnd, Doubles(last.offset[axis]), Doubles(first.offset[axis]));
            (((Doubles(m[0]) * x + Doubles(m[1]) * y) + Doubles(m[2]) * z) + from)
                .store(offset[axis]);
        }
    }
    Doubles operator()(std::size_t i) const {
        return i % 4 == 3 ? Doubles::load(offset[i / 4]) : Doubles(rows[i]);
    }
    const AffineRows& rows; // but for the offsets
    alignas(64) double offset[3][W] = {};
};

// turned: the map does more than move and scale along the axes. A zero of it adds a zero, which
// changes no number.
template <class Map>
[[gnu::always_inline]] inline ObjectRays objectRays(const RayColumns& rays, const Map& m,
                                                    bool turned) {
    const Doubles X(rays.org[0]), Y(rays.org[1]), Z(rays.org[2]);
    const Doubles U(rays.dir[0]), V(rays.dir[1]), T(rays.dir[2]);
    if (!turned)
        return {m(0) * X + m(3), m(5) * Y + m(7), m(10) * Z + m(11), m(0) * U, m(5) * V, m(10) * T};
    const auto direction = [&](std::size_t i) { return (m(i) * U + m(i + 1) * V) + m(i + 2) * T; };
    const auto point = [&](std::size_t i) {
        return ((m(i) * X + m(i + 1) * Y) + m(i + 2) * Z) + m(i + 3);
    };
    return {point(0), point(4), point(8), direction(0), direction(4), direction(8)};
}

// What rays meet of a solid first; of shadow rays, whether they do.
struct FoundLanes {
    Floats t, lost;               // lost: by rounding, as in Hit::u
    unsigned met = 0;             // lanes
    unsigned undecided = 0;       // who can't be sure here asks the shape
    unsigned part[3] = {0, 0, 0}; // bits of Hit::prim, by lane

    std::uint32_t partOf(int lane) const {
        return (part[0] >> lane & 1) | (part[1] >> lane & 1) << 1 | (part[2] >> lane & 1) << 2;
    }
};

// Within their ranges: what hits a ray, and what hides it.
struct RayRanges {
    Floats tMin, best;
    unsigned hits(Floats t) const {
        return bits((t > tMin) & (t <= best) & (t < Floats(kInfinityF)));
    }
    unsigned hides(Floats t) const { return bits((t > tMin) & (t < best)); }
};

// Sides are asked with twice the threshold of AnalyticShape::seesFront(): lanes that see a face
// steeply enough to be sure. `facing`: the direction along a normal of object space, which is the
// same number in the world. `most`: at least the length of that normal there; 2^-50 of it covers
// the rounding of both.
inline unsigned isSteep(const Doubles& facing, const Doubles& most, const RayColumns& rays) {
    const Doubles x(rays.dir[0]), y(rays.dir[1]), z(rays.dir[2]);
    return less(Doubles(0x1p-19) * (most * most) * ((x * x + y * y) + z * z), facing * facing);
}
template <class Map> Doubles rowLength2(const Map& m, std::size_t i) {
    const Doubles x = m(4 * i), y = m(4 * i + 1), z = m(4 * i + 2);
    return (x * x + y * y) + z * z;
}
template <class Map> Doubles rowLength(const Map& m, std::size_t i) {
    return sqrt(rowLength2(m, i));
}
// At least the square of how much longer any normal is in the world.
template <class Map> Doubles normalStretch(const Map& m) {
    return (rowLength2(m, 0) + rowLength2(m, 1)) + rowLength2(m, 2);
}

LANES_END
