// StillShape: a shape with a formula that does not move, as plain numbers. Their only home: shape/
// keeps one in each of its shapes, and kernels that meet the shape or describe its surface look
// at it there.
#pragma once

#include "base/transform.h"

#include <array>
#include <cstddef>
#include <cstdint>

// A flat convex quadrilateral, with its sides as two axes of its space see them, in which it is
// widest: counter-clockwise.
struct StillCorners {
    struct Edge {
        Vec2d from, way;
    };
    Vec3d normal, centre; // normal: of any length
    std::array<Edge, 4> edges;
    std::size_t axisX = 0, axisY = 1;
    Vec2d flat(Vec3d p) const { return {p[axisX], p[axisY]}; }
};

struct StillShape {
    // What lanes can describe the surface of: a sphere, the side of a cylinder, a plane without
    // end.
    enum class Round : std::uint8_t { Sphere, Cylinder, Plane, None };
    static constexpr std::size_t kRounds = 3;

    Transform worldFromObject; // and back
    double radius = 0;         // of a sphere or a cylinder
    // Of a surface's error: what does not depend on the point, but that it grows with coordinates
    // above 1 where the surface has no end; and what it grows by per unit of the largest
    // coordinates of the point and of the shape's place.
    double leastError = 0, errorPerPlace = 0;
    // Of planes: where floor(x) + floor(y) of the object's coordinates is even, and where odd.
    // Others have one.
    std::uint32_t material = 0, oddMaterial = 0;
    std::uint32_t object = 0;
    std::uint32_t part = 0; // Hit::prim of what lanes can describe
    Round round = Round::None;
    bool hasEnd = true;

    const StillCorners* corners = nullptr; // of a plane by corners: the shape's own

    const AffineRows& objectFromWorld() const { return worldFromObject.inverseRows(); }
};
