// Cubes: where all rays of a packet meet one, with the bits of shape/cube.cpp, and which side of it
// they see.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_hulls.h"
#include "accel/kernels/solids_objects.h"
#include "simd/lanes.h"

LANES_BEGIN

struct CubeRoots {
    ObjectRays rays;
    Doubles enter[3], exit[3]; // of the slab of each axis
    Doubles first, last;       // of the cube
    unsigned met, undecided;
};

// Cube::roots(), slab() and intersection(). Where a ray runs along a slab, the quotients are
// infinite, with the signs that hold it in or out; on a face they are 0 / 0.
[[gnu::always_inline]] inline CubeRoots cubeRoots(const ObjectRays& rays) {
    const Doubles zero(0.0), one(1.0), less1(-1.0);
    const auto low = [&](const Doubles& o, const Doubles& d) { return (less1 - o) / d; };
    const auto high = [&](const Doubles& o, const Doubles& d) { return (one - o) / d; };
    const Doubles x0 = low(rays.ox, rays.dx), x1 = high(rays.ox, rays.dx);
    const Doubles y0 = low(rays.oy, rays.dy), y1 = high(rays.oy, rays.dy);
    const Doubles z0 = low(rays.oz, rays.dz), z1 = high(rays.oz, rays.dz);
    CubeRoots out{rays,
                  {min(x0, x1), min(y0, y1), min(z0, z1)},
                  {max(x0, x1), max(y0, y1), max(z0, z1)},
                  zero,
                  zero,
                  rays.usable(),
                  0};
    // Of two equal ones the second is taken, as the first axis is by intersection().
    out.first = max(out.enter[2], max(out.enter[1], out.enter[0]));
    out.last = min(out.exit[2], min(out.exit[1], out.exit[0]));
    const auto isFlat = [&](const Doubles& d) { return atMost(abs(d), zero); };
    if (const unsigned flat = isFlat(min(abs(rays.dx), min(abs(rays.dy), abs(rays.dz)))); flat) {
        const auto onFace = [&](const Doubles& o, const Doubles& d) {
            return isFlat(d) & atMost(abs(o), one) & atMost(one, abs(o));
        };
        out.undecided =
            onFace(rays.ox, rays.dx) | onFace(rays.oy, rays.dy) | onFace(rays.oz, rays.dz);
    }
    out.met &= atMost(out.first, out.last);
    return out;
}

// Lanes that meet each of two axes' faces; the others meet the one that is left.
struct CubeAxes {
    unsigned y, z;
    unsigned choose(unsigned ofX, unsigned ofY, unsigned ofZ) const {
        return (z & ofZ) | (y & ofY) | (~(y | z) & ofX);
    }
};
inline CubeAxes enteredBy(const CubeRoots& roots) {
    const unsigned z = less(max(roots.enter[1], roots.enter[0]), roots.enter[2]);
    return {less(roots.enter[0], roots.enter[1]) & ~z, z};
}
inline CubeAxes leftBy(const CubeRoots& roots) {
    const unsigned z = less(roots.exit[2], min(roots.exit[1], roots.exit[0]));
    return {less(roots.exit[1], roots.exit[0]) & ~z, z};
}

template <Answer A, class Map>
FoundLanes meetCube(const RayColumns& rays, const RayRanges& ranges, const SolidTree::Solid& solid,
                    const Map& map) {
    const CubeRoots roots = cubeRoots(objectRays(rays, map, solid.turned));
    FoundLanes found{.t = Floats(0.0f), .lost = Floats(0.0f)};
    found.undecided = roots.undecided;
    if (roots.met == 0) return found;
    const Floats t0 = roots.first.toFloats(), t1 = roots.last.toFloats();
    if constexpr (A == Answer::Any) {
        found.met = roots.met & (ranges.hides(t0) | ranges.hides(t1));
        return found;
    }
    const CubeAxes in = enteredBy(roots), out = leftBy(roots);
    unsigned first = bits(t0 > ranges.tMin); // lanes that meet the cube where they enter it
    if (solid.side != ::Facets::Side::Both) {
        // The side that is seen is where rays enter, or where they leave.
        first = solid.side == ::Facets::Side::Front ? (1u << W) - 1 : 0;
        const unsigned steep[3] = {isSteep(roots.rays.dx, rowLength(map, 0), rays),
                                   isSteep(roots.rays.dy, rowLength(map, 1), rays),
                                   isSteep(roots.rays.dz, rowLength(map, 2), rays)};
        found.undecided |= roots.met & ~(in.choose(steep[0], steep[1], steep[2]) &
                                         out.choose(steep[0], steep[1], steep[2]));
    }
    const Mask isFirst = maskOf(first);
    found.t = select(isFirst, t0, t1);
    found.met = roots.met & ranges.hits(found.t);
    if (found.met == 0) return found;
    const Floats lost0 = (roots.first - Doubles(t0)).toFloats(),
                 lost1 = (roots.last - Doubles(t1)).toFloats();
    found.lost = select(isFirst, lost0, lost1);
    const auto ahead = [&](const CubeAxes& axes) {
        const Doubles zero(0.0);
        return axes.choose(less(zero, roots.rays.dx), less(zero, roots.rays.dy),
                           less(zero, roots.rays.dz));
    };
    found.part[0] = (first & ~ahead(in)) | (~first & ahead(out));
    found.part[1] = (first & in.y) | (~first & out.y);
    found.part[2] = (first & in.z) | (~first & out.z);
    return found;
}

LANES_END
