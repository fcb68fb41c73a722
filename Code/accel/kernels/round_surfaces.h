// Surfaces of spheres, of the sides of cylinders and of planes without end that stand still, a
// register of them at a time, each on a shape of its own: rays that have bounced off many small
// shapes rarely follow each other on one. Every lane repeats the steps of shape/analytic_shape.cpp
// and of the shape's describe() in double, so that the bits are the same.
#pragma once

#include "base/hit.h"
#include "base/ray_span.h"
#include "base/strided.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// What surfaceFor() needs of the whole shape.
struct RoundToShade {
    // Places of the numbers, which lanes load alike.
    enum Number : std::size_t {
        WorldFromObject = 0,  // Transform::rows()
        ObjectFromWorld = 12, // the same
        Radius = 24,
        LeastError,    // of a surface's error: what does not depend on the point, but that it
                       // grows with coordinates above 1 where the surface has no end
        ErrorPerPlace, // what it grows by per unit of the largest coordinate
        Farthest,      // of those that is, besides the point's: of the shape's own place
        SteepnessOfZ,  // how much z, of a cylinder, changes over a unit of the world
        kNumbers
    };
    enum class Kind : std::uint8_t { Sphere, Cylinder, Plane };
    static constexpr std::size_t kKinds = 3;
    std::array<double, kNumbers> numbers;
    Kind kind;
    std::uint32_t part; // Hit::prim of what this is about
    // Of planes: where floor(x) + floor(y) of the object's coordinates is even, and where odd.
    // Others have one.
    std::uint32_t material, oddMaterial;
    std::uint32_t object;
};

// Hit k is that of ray which[k] on *shapes[k], all of one kind.
struct RoundsMet {
    RaySpan rays;
    std::span<const Hit> hits; // of all rays
    std::span<const std::uint32_t> which;
    std::span<const std::uint32_t> to;
    std::span<const RoundToShade* const> shapes;
};

// out[to[k]] becomes the surface of hit k, without texture coordinates.
using RoundSurfacesFn = void (*)(const RoundsMet&, Strided<Surface> out);
