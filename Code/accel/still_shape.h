// StillShape: a shape with a formula that does not move, as plain numbers. Their only home: shape/
// keeps one in each of its shapes, and kernels that meet the shape or describe its surface look
// at it there.
#pragma once

#include "base/transform.h"

#include <cstddef>
#include <cstdint>

struct StillShape {
    // What lanes can describe the surface of: a sphere, the side of a cylinder.
    enum class Round : std::uint8_t { Sphere, Cylinder, None };
    static constexpr std::size_t kRounds = 2;

    Transform worldFromObject; // and back
    double radius = 0;         // of a sphere or a cylinder
    // Of a surface's error: what does not depend on the point, infinite for what has no end, and
    // what it grows by per unit of the largest coordinates of the point and of the shape's place.
    double leastError = kInfinity, errorPerPlace = 0;
    std::uint32_t material = 0, object = 0;
    std::uint32_t part = 0; // Hit::prim of what is round
    Round round = Round::None;

    const AffineRows& objectFromWorld() const { return worldFromObject.inverseRows(); }
};
