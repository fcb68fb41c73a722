// Surfaces of spheres that stand still, a register of them at a time, each on a sphere of its own:
// rays that have bounced off many small spheres rarely follow each other on one. Every lane repeats
// the steps of shape/analytic_shape.cpp and shape/sphere.cpp in double, so that the bits are the
// same.
#pragma once

#include "base/hit.h"
#include "base/ray_span.h"
#include "base/strided.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// What surfaceFor() needs of the whole sphere.
struct SphereToShade {
    // Places of the numbers, which lanes load alike.
    enum Number : std::size_t {
        WorldFromObject = 0,  // Transform::rows()
        ObjectFromWorld = 12, // the same
        Radius = 24,
        LeastError,    // of a surface's error: what does not depend on the point
        ErrorPerPlace, // what it grows by per unit of the largest coordinate
        Farthest,      // of those that is, besides the point's: of the sphere's own place
        kNumbers
    };
    std::array<double, kNumbers> numbers;
    std::uint32_t material, object;
};

// Hit k is that of ray which[k] on *spheres[k].
struct SpheresMet {
    RaySpan rays;
    std::span<const Hit> hits; // of all rays
    std::span<const std::uint32_t> which;
    std::span<const std::uint32_t> to;
    std::span<const SphereToShade* const> spheres;
};

// out[to[k]] becomes the surface of hit k, without texture coordinates.
using SphereSurfacesFn = void (*)(const SpheresMet&, Strided<Surface> out);
