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

// The side of a cone: `radius` wide at z = -1, `topRadius` at z = 1.
struct StillCone {
    double radius = 0, topRadius = 0;
    double slope = 0;                     // growth of the radius with z
    double narrowZ = 0, narrowRadius = 0; // at the narrow end, the tip of a true cone
    double radiusAt(double z) const { return narrowRadius + slope * (z - narrowZ); }
};

struct StillShape {
    // What lanes can describe the surface of; of cylinders and cones that is the side, and Cap are
    // their ends.
    enum class Kind : std::uint8_t {
        Sphere,
        Cylinder,
        Cone,
        Cube,
        Disk,
        Corners,
        Plane,
        Cap,
        None
    };
    static constexpr auto kKinds = static_cast<std::size_t>(Kind::None);

    Transform worldFromObject; // and back
    double radius = 0;         // of a sphere, a cylinder or a disk
    // Of a surface's error: what does not depend on the point, but that it grows with coordinates
    // above 1 where the surface has no end; and what it grows by per unit of the largest
    // coordinates of the point and of the shape's place.
    double leastError = 0, errorPerPlace = 0;
    // Of planes: where floor(x) + floor(y) of the object's coordinates is even, and where odd.
    // Others have one.
    std::uint32_t material = 0, oddMaterial = 0;
    std::uint32_t object = 0;
    std::uint8_t parts = 0; // a bit for each Hit::prim that lanes can describe
    std::uint8_t caps = 0;  // of these
    Kind kind = Kind::None;
    bool hasEnd = true;
    union { // of a plane by corners, or of a cone: the shape's own
        const StillCorners* corners = nullptr;
        const StillCone* cone;
    };

    Kind kindOf(std::uint32_t part) const { return caps >> part & 1 ? Kind::Cap : kind; }
    const AffineRows& objectFromWorld() const { return worldFromObject.inverseRows(); }
};
