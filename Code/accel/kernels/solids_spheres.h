// Spheres: where all rays of a packet meet one, or each its own, with the bits of shape/sphere.cpp.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids_objects.h"
#include "accel/kernels/solids_tubes.h"
#include "simd/lanes.h"

#include <cstddef>
#include <limits>

LANES_BEGIN

class PacketSpheres : public PacketTubes {
protected:
    using PacketTubes::firstOf, PacketTubes::hides, PacketTubes::meet, PacketTubes::PacketTubes;

    struct SphereRoots {
        Floats t[2], lost[2]; // where rays enter and leave; lost: by rounding
        unsigned met;         // lanes
    };

    // Sphere::roots() and insideRound(), of those lanes.
    template <class Map, class Radius>
    [[gnu::always_inline]] static SphereRoots meet(unsigned lanes, const RayColumns& columns,
                                                   const Map& map, bool turned,
                                                   const Radius& radius) {
        const auto [ox, oy, oz, dx, dy, dz] = objectRays(columns, map, turned);
        const Doubles dd = (dx * dx + dy * dy) + dz * dz, od = (ox * dx + oy * dy) + oz * dz;
        const Doubles oo = (ox * ox + oy * oy) + oz * oz, r(radius), rr = r * r, zero(0.0);
        // Rays that leave it, as mirrored ones do: outside by more than the 2^-48 that oo, ll and
        // along are off by, they have both roots behind them.
        lanes &= ~(less(zero, od) & less(rr * Doubles(1 + 0x1p-30), oo) &
                   bits(columns.tMin >= Floats(0.0f)));
        SphereRoots out{};
        if (lanes == 0) return out;
        const Doubles along = od / dd;
        const Doubles px = ox - dx * along, py = oy - dy * along, pz = oz - dz * along;
        const Doubles ll = (px * px + py * py) + pz * pz;
        lanes &= atMost(ll, rr) & less(zero, r);
        if (lanes == 0) return out;

        const Doubles most(std::numeric_limits<double>::max());
        lanes &= atMost(dd, most) & atMost(oo, most);
        const Doubles middle = zero - along, half = sqrt((rr - ll) / dd);
        const auto put = [&](int end, const Doubles& t) {
            out.t[end] = t.toFloats();
            out.lost[end] = (t - Doubles(out.t[end])).toFloats();
        };
        put(0, middle - half), put(1, middle + half);
        out.met = lanes;
        return out;
    }

    static unsigned hides(const SphereRoots& roots, const RayRanges& ranges) {
        return roots.met & (ranges.hides(roots.t[0]) | ranges.hides(roots.t[1]));
    }

    static FoundLanes firstOf(const SphereRoots& roots, const RayRanges& ranges) {
        const Mask first = roots.t[0] > ranges.tMin;
        const Floats t = select(first, roots.t[0], roots.t[1]);
        return {.t = t,
                .lost = select(first, roots.lost[0], roots.lost[1]),
                .met = roots.met & ranges.hits(t)};
    }

    // Of one that is seen from one side, rays meet where they enter it, or where they leave it:
    // AnalyticShape::seesFront() at both, with twice its threshold.
    template <class Map>
    static FoundLanes firstOf(const SphereRoots& roots, const RayRanges& ranges,
                              ::Facets::Side side, const RayColumns& columns, const Map& map) {
        const ObjectRays rays = objectRays(columns, map, true);
        const Doubles x(columns.dir[0]), y(columns.dir[1]), z(columns.dir[2]), zero(0.0);
        const Doubles least = Doubles(0x1p-19) * ((x * x + y * y) + z * z) * normalStretch(map);
        unsigned sure = ~0u;
        for (const int end : {0, 1}) {
            const Doubles at = Doubles(roots.t[end]) + Doubles(roots.lost[end]);
            const Doubles px = rays.ox + rays.dx * at, py = rays.oy + rays.dy * at,
                          pz = rays.oz + rays.dz * at;
            const Doubles facing = (px * rays.dx + py * rays.dy) + pz * rays.dz;
            sure &= less(least * ((px * px + py * py) + pz * pz), facing * facing) &
                    (end == 0 ? less(facing, zero) : less(zero, facing));
        }
        const int seen = side == ::Facets::Side::Front ? 0 : 1;
        return {.t = roots.t[seen],
                .lost = roots.lost[seen],
                .met = roots.met & ranges.hits(roots.t[seen]),
                .undecided = roots.met & ~sure};
    }
};

LANES_END
