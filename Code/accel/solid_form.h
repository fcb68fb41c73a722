// SolidForm: what kernels know of a shape besides its box (accel/kernels/solids.h).
#pragma once

#include "accel/still_shape.h"
#include "base/bounds.h"
#include "base/motion.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

// All of a shape is at most this far from the centre; or, with an axis (of unit length), from the
// line through the centre along it.
struct RoundHull {
    Vec3d centre, axis;
    double radius = kInfinity;
    // A ball about the centre that is inside of a sphere or a cube; with an axis: that of a
    // straight round tube, of which the shape has all of the side.
    double innerRadius = 0;
    // With an axis, where no inner one is known: of a straight round tube inside of the shape, from
    // end to end. What comes into it from outside of the hull, and by no end, has met the side.
    double coreRadius = 0;
    double halfLength = kInfinity; // along the axis, to both sides of the centre
};

// A few triangles that stand still, in the order of their numbers: floors, walls and the like.
struct Facets {
    enum class Side : std::uint8_t { Both, Front, Back }; // that rays of sight meet
    static constexpr std::size_t kMost = 4;
    std::vector<std::array<Vec3, 3>> triangles;
    float extent = 0; // see RaySetup
    Side side = Side::Both;
};

// A tube about the z axis of its object space, |z| <= 1. A kernel that meets it
// repeats the formulas of shape/cylinder.cpp or shape/cone.cpp.
struct StillTube {
    const StillShape* shape = nullptr;
    bool caps = false; // has ends, too
    double radius = 0; // of a cone: at the narrow end
    struct Cone {
        double slope = 0, narrowZ = 0;
    };
    std::optional<Cone> cone{};                      // else a cylinder
    Facets::Side side = Facets::Side::Both;          // that rays of sight meet
    enum Part : std::uint32_t { Wall, Bottom, Top }; // Hit::prim
};

// Flat faces in their object space: the cube [-1,1]^3, a disk about the origin in
// z = 0, a plane by corners, or all of z = 0. A kernel that meets them repeats the formulas of
// shape/cube.cpp, shape/disk.cpp, shape/plane.cpp or shape/infinite_plane.cpp.
struct StillFaces {
    enum class Of : std::uint8_t { Cube, Disk, Corners, Endless };
    const StillShape* shape = nullptr;
    Of of = Of::Cube;
    Facets::Side side = Facets::Side::Both; // that rays of sight meet
};

// How a sphere, a tube or faces move, of which the rest of the form is said at their first key.
struct SolidMotion {
    std::optional<Drift> drift;               // without turning or growing; or
    const MovingTransform* turning = nullptr; // in any way, and then
    double reach = kInfinity; // how far all is, at any time, from where the origin is
};

// What it points to is the shape's own.
struct SolidForm {
    RoundHull hull;
    // The shape is a sphere about the origin of its object space. A kernel that meets it repeats
    // the formulas of shape/sphere.cpp.
    const StillShape* sphere = nullptr;
    Facets::Side sphereSide = Facets::Side::Both; // that rays of sight meet
    std::optional<Facets> facets{};               // or these
    std::optional<StillTube> tube{};              // or this one
    std::optional<StillFaces> faces{};            // or these
    std::optional<SolidMotion> motion{};          // of all but facets
};

inline RoundHull ballAround(const BoundsD& box) {
    return {.centre = box.centre(), .axis = {}, .radius = 0.5 * length(box.size())};
}
