// Surfaces of spheres that stand still, a register of them at a time. Every lane repeats the steps
// of shape/analytic_shape.cpp and shape/sphere.cpp in double, so that the bits are the same.
#pragma once

#include "accel/kernels/kernels.h"
#include "base/hit.h"
#include "base/ray_span.h"
#include "base/strided.h"

#include <array>
#include <cstdint>
#include <span>

// What surfaceFor() needs of the whole sphere; the maps are Transform::rows().
struct SphereToShade {
    std::array<double, 12> worldFromObject, objectFromWorld;
    double radius;
    double leastError;    // of a surface's error: what does not depend on the point
    double errorPerPlace; // what it grows by per unit of the largest coordinate
    double farthest;      // of those that is, besides the point's: of the sphere's own place
    std::uint32_t material, object;
};

// out[k] becomes the surface, without texture coordinates, of the hit of ray which[k].
using SphereSurfacesFn = void (*)(const SphereToShade&, const RaySpan&, std::span<const Hit>,
                                  std::span<const std::uint32_t> which, Strided<Surface> out);
// Null for the scalar kernel.
SphereSurfacesFn sphereSurfaces(const Kernel& kernel);
