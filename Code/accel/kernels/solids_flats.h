// Disks and planes, by corners or endless: where all rays of a packet meet one, with the bits of
// shape/disk.cpp, shape/plane.cpp and shape/infinite_plane.cpp, and which side of it they see.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_hulls.h"
#include "accel/kernels/solids_objects.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <cmath>
#include <cstddef>
#include <limits>

LANES_BEGIN

// Lines that meet a flat shape, at most once.
struct FlatRoots {
    Doubles t, facing; // facing: along the normal
    unsigned met;      // t is finite here
};

// InfinitePlane::roots()
inline FlatRoots endlessRoots(const ObjectRays& rays) {
    const Doubles zero(0.0), minus(-0.0);
    return {(minus - rays.oz) / rays.dz, rays.dz, less(zero, abs(rays.dz)) & rays.usable()};
}

// Disk::roots()
inline FlatRoots diskRoots(const ObjectRays& rays, const StillShape& shape) {
    const Doubles zero(0.0), radius(shape.radius);
    FlatRoots roots = endlessRoots(rays);
    const Doubles x = rays.ox + rays.dx * roots.t, y = rays.oy + rays.dy * roots.t;
    roots.met &= less(zero, radius) & atMost(x * x + y * y, radius * radius);
    return roots;
}

// Plane::roots()
inline FlatRoots cornerRoots(const ObjectRays& rays, const StillShape& shape) {
    const auto& [n, centre, edges, axisX, axisY] = *shape.corners;
    const Doubles zero(0.0), most(std::numeric_limits<double>::max());
    const Doubles nx(n.x), ny(n.y), nz(n.z);
    const Doubles slope = (nx * rays.dx + ny * rays.dy) + nz * rays.dz;
    const Doubles ahead =
        (nx * (Doubles(centre.x) - rays.ox) + ny * (Doubles(centre.y) - rays.oy)) +
        nz * (Doubles(centre.z) - rays.oz);
    const Doubles t = ahead / slope;
    const auto at = [&](std::size_t axis) {
        return axis == 0   ? rays.ox + rays.dx * t
               : axis == 1 ? rays.oy + rays.dy * t
                           : rays.oz + rays.dz * t;
    };
    const Doubles x = at(axisX), y = at(axisY);
    unsigned met = less(zero, abs(slope)) & atMost(abs(t), most) & rays.usable();
    for (const StillCorners::Edge& edge : edges) {
        if (met == 0) break;
        met &= atMost(zero, Doubles(edge.way.x) * (y - Doubles(edge.from.y)) -
                                Doubles(edge.way.y) * (x - Doubles(edge.from.x)));
    }
    return {t, slope, met};
}

// At least the length of the normal in the world.
template <class Map> Doubles steepest(const SolidTree::Solid& solid, const Map& m) {
    if (solid.kind != SolidTree::Kind::Corners) return rowLength(m, 2);
    const Vec3d n = solid.shape->corners->normal;
    return (Doubles(std::fabs(n.x)) * rowLength(m, 0) + Doubles(std::fabs(n.y)) * rowLength(m, 1)) +
           Doubles(std::fabs(n.z)) * rowLength(m, 2);
}

template <Answer A, class Map>
FoundLanes meetFlat(const RayColumns& rays, const RayRanges& ranges, const SolidTree::Solid& solid,
                    const Map& map) {
    const ObjectRays local = objectRays(rays, map, solid.turned);
    const FlatRoots roots = solid.kind == SolidTree::Kind::Endless ? endlessRoots(local)
                            : solid.kind == SolidTree::Kind::Disk
                                ? diskRoots(local, *solid.shape)
                                : cornerRoots(local, *solid.shape);
    const Floats t = roots.t.toFloats();
    FoundLanes found{.t = t, .lost = Floats(0.0f)};
    found.met = roots.met & (A == Answer::Any ? ranges.hides(t) : ranges.hits(t));
    if (A == Answer::Any || found.met == 0) return found;
    found.lost = (roots.t - Doubles(t)).toFloats();
    if (solid.side != ::Facets::Side::Both) {
        const Doubles zero(0.0);
        const unsigned front = less(roots.facing, zero);
        found.undecided = found.met & ~isSteep(roots.facing, steepest(solid, map), rays);
        found.met &= solid.side == ::Facets::Side::Front ? front : ~front;
    }
    return found;
}

LANES_END
