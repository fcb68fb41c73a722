// Ray: a half line with the part of it that counts and its time in the shutter.
// Knows nothing about shapes.
#pragma once

#include "base/math.h"
#include "base/vec.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

// A hit counts when tMin < t < tMax; tMin is not below 0. `dir` need not be a unit vector: t is in
// units of dir. time is in [0,1] of the shutter.
struct Ray {
    Vec3 org, dir;
    float tMin = 0, tMax = kInfinityF, time = 0;
    constexpr Vec3 at(float t) const { return org + dir * t; }
};

// A ray in the space of an object, where intersections are computed in double. t is the same
// number as on the world's ray, as transforms do not normalise dir.
struct RayD {
    Vec3d org, dir;
    constexpr Vec3d at(double t) const { return org + dir * t; }
};

constexpr RayD toDouble(const Ray& ray) { return {toDouble(ray.org), toDouble(ray.dir)}; }

// RaySpan: a view of a batch of rays, as a structure of arrays. Ray i is element i of each.

struct RaySpan {
    std::span<const Vec3> org, dir;
    std::span<const float> tMin, tMax, time;

    std::size_t size() const { return org.size(); }
    Ray operator[](std::size_t i) const { return {org[i], dir[i], tMin[i], tMax[i], time[i]}; }
};

// What a ray meets: Hit is all that traversal carries, Surface is computed once for the winner.

struct Hit {
    float t = std::numeric_limits<float>::infinity(); // in units of the ray's direction
    float u = 0, v = 0;                               // barycentrics of a triangle, else unused
    std::uint32_t prim = 0;                           // triangle of a mesh, part of another shape
    std::uint32_t shape = kNoShape;
    static constexpr std::uint32_t kNoShape = 0xffffffffu;
    bool isHit() const { return shape != kNoShape; }
    bool operator==(const Hit&) const = default;
};

// All in world space; normals have unit length and point to the outside of the shape (for a flat
// shape: along its +Z), whichever side the ray came from.
struct Surface {
    Vec3 p;
    Vec3 ng; // of the geometry
    Vec3 ns; // interpolated; within 90 degrees of ng
    Vec2 uv;
    std::uint32_t material = 0; // index into the scene's materials
    std::uint32_t object = 0;   // index of the object in the scene file
    // Bound of the distance between p and the surface that the shape's own intersection test sees,
    // rounding of p included: a ray that starts this far off along ng stays on its side.
    float error = 0;
    // The test sees the end of a ray displaced by up to this part of the ray's length: 0 for shapes
    // that take rays as they are and reckon in double.
    float rayError = 0;
    // From p to the curved surface that interpolated normals pretend, on the side of the ray where
    // that is convex; zero elsewhere. Shadow rays that start there end the shadow of a coarse mesh
    // where the shading ends it.
    Vec3 lift;
};

// Parts of a Surface that cost time, and are of no use in some pictures.
struct SurfaceNeeds {
    bool uv = true, lift = true;
};

// Change of the position with the texture coordinates, for bump and normal maps.
struct SurfaceDerivatives {
    Vec3 dpdu, dpdv;
    bool isEven = false; // the same for all rays and wherever they meet this primitive
};
