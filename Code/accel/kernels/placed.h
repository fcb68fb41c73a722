// Placed meshes: batches of rays among meshes that are somewhere in the scene, each with a wide
// tree in a space of its own. A tree over their boxes says which of them a ray enters; there the
// kernel takes the ray through the tree of the mesh. It knows neither how a ray comes into that
// space nor what a hit is: a PlacedQuery does, and is asked about the triangles that a ray may
// meet.
#pragma once

#include "accel/kernels/solids.h"

#include <cstdint>
#include <span>

// A ray in the tree of a mesh. What is left out is certain not to matter to the query.
struct TreeVisit {
    const WideTree* tree = nullptr;
    // By line of the tree's nodes and leaves: the longest side of a triangle in it.
    const float* longestSide = nullptr;
    const RaySetup* setup = nullptr;
    // As the object has them, of the points of the leaves: of the leaf at line n from kPerLine n
    // on.
    const Vec3d* exactPoints = nullptr;
    static constexpr std::size_t kPerLine = 4;
    // How far before or behind the place where the ray passes a triangle its hit may be, for each
    // unit of the triangle's longest side.
    float depthPerSide = 0;
    float lateralError = 0; // of a corner relative to the ray
    float zCut = 0;         // behind it nothing is wanted
};

// The questions of a batch of rays. A ray has the same slot from start() until the next start().
class PlacedQuery {
public:
    virtual ~PlacedQuery() = default;
    // t behind which nothing is wanted before the ray starts.
    virtual float limit(std::uint32_t ray) const = 0;
    // The ray comes near the meshes.
    virtual void start(std::uint32_t slot, std::uint32_t ray) = 0;
    // It enters the box of a mesh, at depth zEntry in the scene. False: there is nothing to walk.
    virtual bool enter(std::uint32_t slot, std::uint32_t number, float zEntry,
                       TreeVisit& visit) = 0;
    // It may meet the triangle of these exact corners. The new TreeVisit::zCut; negative: it has
    // seen enough of the mesh.
    virtual float test(std::uint32_t slot, std::uint32_t triangle, const Vec3d& a, const Vec3d& b,
                       const Vec3d& c) = 0;
    // It is through with what enter() has let it into, or not. The new zCut in the scene; negative:
    // it is through with everything.
    virtual float leave(std::uint32_t slot) = 0;
};

struct PlacedTree {
    SolidTree boxes; // of the meshes, by their numbers
    Bounds whole;
    // Stacks are not larger: of the tree over the boxes, of the trees of the meshes.
    std::uint32_t boxStack = 0, meshStack = 0;
};
// More than a traversal ever has on its stack.
std::uint32_t stackSize(const SolidTree& tree);

struct PlacedKernel {
    static constexpr std::uint32_t kSlots = 64;
    // Only rays in `order` are looked at. Those of nearest hits go to near meshes and boxes first.
    void (*closest)(const PlacedTree&, PlacedQuery&, const RaySpan&,
                    std::span<const std::uint32_t> order);
    void (*any)(const PlacedTree&, PlacedQuery&, const RaySpan&,
                std::span<const std::uint32_t> order);
};
