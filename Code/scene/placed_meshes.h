// PlacedMeshes: the instances among the shapes of a scene, for batches of rays. A kernel finds the
// candidates (accel/kernels/placed.h); what is a hit MeshInstance says, as for single rays.
#pragma once

#include "accel/kernels/placed.h"
#include "shape/shape.h"

#include <cstdint>
#include <span>
#include <vector>

struct ShapeSet;

class PlacedMeshes {
public:
    // By the number of a shape that is a MeshInstance with a wide tree; whether it is opaque.
    void add(const Bounds& box, std::uint32_t number, bool hides, const WideTree& tree);
    // Once after the last add().
    void build(const Isa& kernel, float extent, int threads);
    bool isEmpty() const { return boxes_.empty(); }
    const SolidTree& boxes() const { return tree_.boxes; } // the tree, by the shapes' numbers

    // hits[i] is the best hit of ray i so far and becomes the best of all.
    void closest(const ShapeSet& set, const RaySpan& rays, std::span<Hit> hits) const;
    // hidden[i] becomes 1 where an opaque instance is in (tMin, tMax).
    void occluded(const ShapeSet& set, const RaySpan& rays, std::span<std::uint8_t> hidden) const;

private:
    const PlacedKernel* kernel_ = nullptr;
    std::vector<Bounds> boxes_;
    PlacedTree tree_;
};
