// The numbers of shapes, of one for all lanes or of one for each, and their maps.
#pragma once

#include "accel/kernels/vectors3.h"
#include "accel/still_shape.h"
#include "base/affine.h"
#include "base/math.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <cstddef>
#include <span>
#include <type_traits>

LANES_BEGIN

using Kind = StillShape::Kind;

// Places of a shape's numbers.
enum Number : std::size_t {
    WorldFromObject = 0,  // Transform::rows()
    ObjectFromWorld = 12, // the same
    Radius = 24,
    LeastError,
    ErrorPerPlace,
    Own, // what only some kinds have
    NormalX = Own,
    NormalY,
    NormalZ,
    CentreX,
    CentreY,
    CentreZ,
    OriginX, // and what follows as the two axes of the plane see it: the first corner,
    OriginY,
    AlongUX, // the side from there to the second one,
    AlongUY,
    AlongVX, // to the fourth,
    AlongVY,
    BentX, // and how much longer than this the opposite side is
    BentY,
    AxisX, // 0 to 2
    AxisY,
    kNumbers,
    Slope = Own,
    NarrowZ,
    NarrowRadius,
    Widest
};

// put(place, number) for all of a shape.
template <Kind kKind, class PutFn> void forEachNumber(const StillShape& shape, PutFn&& put) {
    const AffineRows& there = shape.worldFromObject.rows();
    const AffineRows& back = shape.objectFromWorld();
    for (std::size_t k = 0; k < 12; ++k) put(WorldFromObject + k, there[k]);
    for (std::size_t k = 0; k < 12; ++k) put(ObjectFromWorld + k, back[k]);
    put(Radius, shape.radius);
    put(LeastError, shape.leastError);
    put(ErrorPerPlace, shape.errorPerPlace);
    if constexpr (kKind == Kind::Corners) {
        const auto& [n, centre, edges, axisX, axisY] = *shape.corners;
        put(NormalX, n.x), put(NormalY, n.y), put(NormalZ, n.z);
        put(CentreX, centre.x), put(CentreY, centre.y), put(CentreZ, centre.z);
        const Vec2d from = edges[0].from, u = edges[0].way, v = edges[3].from - from,
                    bent = edges[1].way - v;
        put(OriginX, from.x), put(OriginY, from.y);
        put(AlongUX, u.x), put(AlongUY, u.y), put(AlongVX, v.x), put(AlongVY, v.y);
        put(BentX, bent.x), put(BentY, bent.y);
        put(AxisX, static_cast<double>(axisX)), put(AxisY, static_cast<double>(axisY));
    }
    if constexpr (kKind == Kind::Cone) {
        const StillCone& cone = *shape.cone;
        put(Slope, cone.slope), put(NarrowZ, cone.narrowZ), put(NarrowRadius, cone.narrowRadius);
        put(Widest, ::max(cone.radius, cone.topRadius));
    }
}

// The numbers of a shape that all lanes are on, or of one for each lane.
template <Kind kKind> struct NumbersOfOne {
    explicit NumbersOfOne(const StillShape& shape) {
        forEachNumber<kKind>(shape, [&](std::size_t place, double number) { of[place] = number; });
    }
    Doubles operator()(std::size_t number) const { return Doubles(of[number]); }
    double of[kNumbers];
};
template <Kind kKind> struct NumbersOfMany {
    // Lanes behind the last shape repeat it.
    explicit NumbersOfMany(std::span<const StillShape* const> shapes) {
        for (std::size_t i = 0; i < W; ++i)
            forEachNumber<kKind>(*shapes[i < shapes.size() ? i : shapes.size() - 1],
                                 [&](std::size_t place, double number) { of[place][i] = number; });
    }
    Doubles operator()(std::size_t number) const { return Doubles::load(of[number]); }
    alignas(64) double of[kNumbers][W];
};

// Rows i, i + step .. of a map's linear part.
template <class Numbers>
[[gnu::always_inline]] inline Doubles row(const Numbers& m, std::size_t i, std::size_t step,
                                          const Doubles3& v) {
    return (m(i) * v.x + m(i + step) * v.y) + m(i + 2 * step) * v.z;
}
template <class Numbers>
[[gnu::always_inline]] inline Doubles3 vectorOf(const Numbers& m, Number map, const Doubles3& v) {
    return {row(m, map, 1, v), row(m, map + 4, 1, v), row(m, map + 8, 1, v)};
}
template <class Numbers>
[[gnu::always_inline]] inline Doubles3 pointOf(const Numbers& m, Number map, const Doubles3& p) {
    const Doubles3 v = vectorOf(m, map, p);
    return {v.x + m(map + 3), v.y + m(map + 7), v.z + m(map + 11)};
}

template <class Numbers> Doubles3 normalOf(const Numbers& m, const Doubles3& n) {
    const Doubles3 steep{row(m, ObjectFromWorld, 4, n), row(m, ObjectFromWorld + 1, 4, n),
                         row(m, ObjectFromWorld + 2, 4, n)};
    return steep / sqrt(dot(steep, steep));
}

// In the space of a flat shape.
template <Kind kKind, class Numbers> Doubles3 flatNormal(const Numbers& shape) {
    if constexpr (kKind == Kind::Corners)
        return {shape(NormalX), shape(NormalY), shape(NormalZ)};
    else
        return {Doubles(0.0), Doubles(0.0), Doubles(1.0)};
}

// The numbers of a flat shape, with its one normal.
template <Kind kKind> struct NumbersOfFlat : NumbersOfOne<kKind> {
    explicit NumbersOfFlat(const StillShape& shape)
        : NumbersOfOne<kKind>(shape), normal(normalOf(*this, flatNormal<kKind>(*this))) {}
    Doubles3 normal;
};
template <Kind kKind>
using NumbersOf =
    std::conditional_t<kKind == Kind::Disk || kKind == Kind::Plane || kKind == Kind::Corners,
                       NumbersOfFlat<kKind>, NumbersOfOne<kKind>>;

LANES_END
