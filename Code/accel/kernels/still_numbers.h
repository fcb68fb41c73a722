// The numbers of the shapes that W lanes are on, and their maps.
#pragma once

#include "simd/vectors3.h"
#include "accel/still_shape.h"
#include "base/transform.h"
#include "base/math.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <cstddef>
#include <span>

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

// Calls put(place, number) for all numbers of a shape.
template <class PutFn> void forEachNumber(const StillShape& shape, PutFn&& put) {
    const AffineRows& there = shape.worldFromObject.rows();
    const AffineRows& back = shape.objectFromWorld();
    for (std::size_t k = 0; k < 12; ++k) put(WorldFromObject + k, there[k]);
    for (std::size_t k = 0; k < 12; ++k) put(ObjectFromWorld + k, back[k]);
    put(Radius, shape.radius);
    put(LeastError, shape.leastError);
    put(ErrorPerPlace, shape.errorPerPlace);
    if (shape.kind == Kind::Corners) {
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
    if (shape.kind == Kind::Cone) {
        const StillCone& cone = *shape.cone;
        put(Slope, cone.slope), put(NarrowZ, cone.narrowZ), put(NarrowRadius, cone.narrowRadius);
        put(Widest, ::max(cone.radius, cone.topRadius));
    }
}

class StillNumbers {
public:
    // All lanes are on one shape.
    explicit StillNumbers(const StillShape& shape) {
        forEachNumber(shape,
                      [&](std::size_t place, double number) { Doubles(number).store(of_[place]); });
    }
    // Each lane is on a shape of its own; those behind the last shape repeat it.
    explicit StillNumbers(std::span<const StillShape* const> shapes) {
        for (std::size_t i = 0; i < W; ++i)
            forEachNumber(*shapes[i < shapes.size() ? i : shapes.size() - 1],
                          [&](std::size_t place, double number) { of_[place][i] = number; });
    }
    Doubles operator()(std::size_t number) const { return Doubles::load(of_[number]); }

private:
    alignas(64) double of_[kNumbers][W];
};

// Rows i, i + step .. of a map's linear part.
[[gnu::always_inline]] inline Doubles row(const StillNumbers& m, std::size_t i, std::size_t step,
                                          const Doubles3& v) {
    return (m(i) * v.x + m(i + step) * v.y) + m(i + 2 * step) * v.z;
}
[[gnu::always_inline]] inline Doubles3 vectorOf(const StillNumbers& m, Number map,
                                                const Doubles3& v) {
    return {row(m, map, 1, v), row(m, map + 4, 1, v), row(m, map + 8, 1, v)};
}
[[gnu::always_inline]] inline Doubles3 pointOf(const StillNumbers& m, Number map,
                                               const Doubles3& p) {
    const Doubles3 v = vectorOf(m, map, p);
    return {v.x + m(map + 3), v.y + m(map + 7), v.z + m(map + 11)};
}

inline Doubles3 normalOf(const StillNumbers& m, const Doubles3& n) {
    const Doubles3 steep{row(m, ObjectFromWorld, 4, n), row(m, ObjectFromWorld + 1, 4, n),
                         row(m, ObjectFromWorld + 2, 4, n)};
    return steep / sqrt(dot(steep, steep));
}

LANES_END
