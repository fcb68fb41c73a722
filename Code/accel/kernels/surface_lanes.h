// What a kernel does for surfaces.
#pragma once

#include "accel/solid_form.h"
#include "accel/still_shape.h"
#include "base/ray.h"
#include "base/surface_block.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

// Surfaces of shapes with a formula that stand still, a register of them at a time, each on a shape
// of its own: rays that have bounced off many small shapes rarely follow each other on one. Every
// lane repeats the steps of shape/analytic_shape.cpp and of the shape's describe() in double, so
// that the bits are the same.

// Hit k is that of ray which[k] on *shapes[k], all of one kind.
struct StillsMet {
    StillShape::Kind kind;
    RaySpan rays;
    std::span<const Hit> hits; // of all rays
    std::span<const std::uint32_t> which;
    std::span<const std::uint32_t> to;
    std::span<const StillShape* const> shapes;
    bool wantsUv = false; // else texture coordinates stay as they are
};

// out[to[k]] becomes the surface of hit k, in a block that was cleared.
using StillSurfacesFn = void (*)(const StillsMet&, SurfacePlaces out);

// Surfaces of triangles, a register of them at a time, as surfaceOf() of shape/mesh_surface.h has
// them: the same operations in the same order. Knows numbers only; shape/mesh_surface.cpp brings
// them here and takes them away.

// Hits on triangles, component by component.
struct alignas(64) TrianglesMet {
    static constexpr std::size_t kHits = 16;
    using Lane = float[kHits];
    Lane corner[3][3]; // by corner, then by axis
    Lane normal[3][3]; // of those that are smooth
    Lane u, v;
    Lane dir[3]; // of the ray
    // One bit for each hit.
    unsigned used = 0;
    unsigned smooth = 0; // the corners have normals
    bool onOne = false;  // corners and normals are those of the first hit
    bool wantsLift = true;
};

struct alignas(64) TriangleSurfaces {
    using Lane = TrianglesMet::Lane;
    Lane p[3], ng[3], ns[3], lift[3], error;
    unsigned unknown; // too near an edge, or without area: surfaceOf() knows
};

using TriangleSurfacesFn = void (*)(const TrianglesMet&, TriangleSurfaces&);

// The vertex's part of the error of a hit: what Woop's test and the plane key lose to rounding,
// about 8 units of the largest coordinate difference, doubled. See RaySetup for the pads.
inline constexpr double kTriangleError = 0x1p-20;

// Rays leave a surface kTriangleError off its plane; this many times as far from its edges they are
// on the inner side of the neighbours as well, down to an angle of 30 degrees between both.
inline constexpr double kEdgeClearance = 2;

// Null where a kernel leaves them to the shapes.
struct SurfaceLanes {
    StillSurfacesFn stills = nullptr;
    TriangleSurfacesFn triangles = nullptr;
};
