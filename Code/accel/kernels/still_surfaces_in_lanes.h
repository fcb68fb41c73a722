// The surfaces of W hits, as AnalyticShape::surfaceOf() and the describe() of the shapes have them:
// the same operations in the same order.
#pragma once

#include "accel/kernels/still_numbers.h"
#include "accel/kernels/still_points.h"
#include "accel/kernels/surface_lanes.h"
#include "accel/kernels/still_uv.h"
#include "accel/kernels/surface_columns.h"
#include "simd/vectors3.h"
#include "simd/lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

LANES_BEGIN

// The outward normals of the faces of cubes that are met.
inline Doubles3 facesMet(std::span<const Hit> hits, const RaysOfLanes& ray) {
    alignas(64) double n[3][W] = {};
    for (std::size_t i = 0; i < W; ++i) {
        const std::uint32_t face = hits[ray[i]].prim;
        n[face / 2][i] = face % 2 == 0 ? -1 : 1;
    }
    return {Doubles::load(n[0]), Doubles::load(n[1]), Doubles::load(n[2])};
}

// Of the caps of cylinders and cones that are met: radius, how much the side slopes, and +-1 for
// the end.
inline Doubles3 capsMet(const StillsMet& met, std::size_t first, std::size_t count) {
    alignas(64) double radius[W], slope[W], side[W];
    for (std::size_t i = 0; i < W; ++i) {
        const std::size_t k = first + std::min(i, count - 1);
        const StillShape& shape = *met.shapes[k];
        const bool isTop = met.hits[met.which[k]].prim == StillTube::Top;
        const bool isCone = shape.kind == Kind::Cone;
        radius[i] = !isCone ? shape.radius : isTop ? shape.cone->topRadius : shape.cone->radius;
        slope[i] = isCone ? std::fabs(shape.cone->slope) : 0;
        side[i] = isTop ? 1 : -1;
    }
    return {Doubles::load(radius), Doubles::load(slope), Doubles::load(side)};
}

// Describes the points of W hits of one kind. `face` is what pulledOnto() takes.
inline void describe(Kind kind, const StillNumbers& shape, const RaysInLanes& world,
                     const Doubles3& face, SurfacesInLanes& out) {
    constexpr double kThreeUlps = 3 * 0x1p-24;
    const Doubles3 seen = along(world.org, world.dir, world.t);
    const auto largest = [](const Doubles3& v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); };
    const Doubles3 centre{shape(WorldFromObject + 3), shape(WorldFromObject + 7),
                          shape(WorldFromObject + 11)};
    Doubles leastError = shape(LeastError);
    if (kind == Kind::Plane) leastError = leastError * max(largest(seen), Doubles(1.0));
    const Doubles fixedError =
        leastError + shape(ErrorPerPlace) * (largest(seen) + largest(centre));

    const Doubles3 met = along(pointOf(shape, ObjectFromWorld, world.org),
                               vectorOf(shape, ObjectFromWorld, world.dir), world.t);
    const Doubles clearance =
        Doubles(2.0) * (Doubles(kThreeUlps) * sqrt(dot(seen, seen)) + fixedError);
    const Local local = pulledOnto(kind, shape, met, face, clearance);
    if (kind == Kind::Plane) out.odd = oddSquares(met.x.toFloats(), met.y.toFloats());
    if (out.hasUv) {
        const auto [u, v] = uvOf(kind, shape, local, face);
        u.toFloats().store(out.uv[0]), v.toFloats().store(out.uv[1]);
    }
    const Doubles3 rough = pointOf(shape, WorldFromObject, local.p);
    const Doubles3 back = pointOf(shape, ObjectFromWorld, rough);
    const Doubles3 p = rough + vectorOf(shape, WorldFromObject, local.p - back);

    const Doubles3 normal = normalOf(shape, local.normal);
    const Doubles rounding = (abs(normal.x * p.x) + abs(normal.y * p.y)) + abs(normal.z * p.z);
    store(p, out.p), store(normal, out.n);
    roundedUp(Doubles(kThreeUlps) * rounding + fixedError).store(out.error);
}

// All lanes are on one shape.
inline void setMaterials(const StillShape& shape, SurfacesInLanes& found) {
    select(maskOf(found.odd), Ints(shape.oddMaterial), Ints(shape.material)).store(found.material);
    Ints(shape.object).store(found.object);
}
inline void findMaterials(std::span<const StillShape* const> shapes, SurfacesInLanes& found) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const StillShape& shape = *shapes[i];
        found.material[i] = (found.odd >> i & 1) != 0 ? shape.oddMaterial : shape.material;
        found.object[i] = shape.object;
    }
}

void stillSurfaces(const StillsMet& met, SurfacePlaces out) {
    SurfacesInLanes found;
    found.hasUv = met.wantsUv;
    const StillShape* last = nullptr;
    std::optional<StillNumbers> ofLast;
    const auto read = [&](std::size_t first, std::size_t count, HitRayColumns& rays) {
        rays.read(met.rays, met.hits, RaysOfLanes(met.which.subspan(first, count)), count);
    };
    const auto use = [&](std::size_t first, std::size_t count, const HitRayColumns& columns) {
        const RaysInLanes rays = columns.lanes();
        Doubles3 face = rays.dir;
        if (met.kind == Kind::Cube)
            face = facesMet(met.hits, RaysOfLanes(met.which.subspan(first, count)));
        if (met.kind == Kind::Cap) face = capsMet(met, first, count);
        const auto shapes = met.shapes.subspan(first, count);
        const auto isFirst = [&](const StillShape* other) { return other == shapes[0]; };
        if (std::all_of(shapes.begin() + 1, shapes.end(), isFirst)) {
            if (shapes[0] != last) last = shapes[0], ofLast.emplace(*last);
            describe(met.kind, *ofLast, rays, face, found);
            setMaterials(*last, found);
        } else {
            describe(met.kind, StillNumbers(shapes), rays, face, found);
            findMaterials(shapes, found);
        }
        found.put(met.to.subspan(first, count), out);
    };
    readAhead<HitRayColumns>(met.which.size(), read, use);
}

LANES_END
