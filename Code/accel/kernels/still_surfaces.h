// Surfaces of shapes with a formula that stand still, a register of them at a time, each on a shape
// of its own: rays that have bounced off many small shapes rarely follow each other on one. Every
// lane repeats the steps of shape/analytic_shape.cpp and of the shape's describe() in double, so
// that the bits are the same.
#pragma once

#include "accel/solid_form.h"
#include "accel/still_shape.h"
#include "base/hit.h"
#include "base/ray_span.h"
#include "base/surface_block.h"

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

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
