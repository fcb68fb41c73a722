// StillBalls: the spheres of a scene that differ in place and size only, as most do, with what
// their surfaces are made of in one piece each: of ten thousand whole shapes the nearest caches
// hold few.
#pragma once

#include "accel/still_shape.h"
#include "base/hit.h"
#include "base/raw_vector.h"
#include "base/ray_span.h"
#include "base/surface_block.h"

#include <cstdint>
#include <span>
#include <vector>

class StillBalls {
public:
    struct Ball {
        Vec3d centre;
        double radius, leastError; // of StillShape
        std::uint32_t material, object;
    };

    // Of a set of so many shapes.
    void resize(std::size_t shapes) { count_ = shapes; }
    // Returns if the shape is such a sphere, by the measure of the first one that is.
    bool take(std::size_t number, const StillShape& shape);

    bool isEmpty() const { return isBall_.empty(); }
    bool has(std::size_t number) const { return isBall_[number] != 0; } // when not empty
    const Ball& operator[](std::size_t number) const { return balls_[number]; }

    // What all of them share: their maps scale by the same number above 0 in all directions, back
    // by another one, and turn nothing. No coordinate of their places is 0.
    struct Shared {
        double scale = 0, back = 0, errorPerPlace = 0;
        bool operator==(const Shared&) const = default;
    };
    const Shared& shared() const { return shared_; }

private:
    Shared shared_;
    std::size_t count_ = 0;
    std::vector<std::uint8_t> isBall_; // by shape; empty: none is
    RawVector<Ball> balls_;            // by shape; only those of balls are written
};

// Hit k is that of ray which[k] on the ball with the number of its shape.
struct BallsMet {
    RaySpan rays;
    std::span<const Hit> hits; // of all rays
    std::span<const std::uint32_t> which;
    std::span<const std::uint32_t> to;
    const StillBalls& balls;
};

// out[to[k]] becomes the surface of hit k: see still_surfaces.h.
using BallSurfacesFn = void (*)(const BallsMet&, SurfacePlaces out);
