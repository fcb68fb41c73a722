// LampMap: the solids that a point lamp sees in each direction, nearest first, so that most shadow
// rays need no walk through the tree (Haines and Greenberg, "The Light Buffer", IEEE CG&A 6, 1986).
// Directions are the cells of a picture that the lamp takes of the solids. What the map says is
// sure; where it can't tell, a ray has to be asked.
#pragma once

#include "accel/kernels/kernels.h"
#include "render/lamp_map/mapped_shapes.h"
#include "render/waves/lamp_lanes.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct LampMap {
    std::shared_ptr<const MappedShapes> shapes;
    std::vector<Occluder> others; // what hides what from this lamp
    Vec3 lamp;
    float slack = 0; // that covers rounding, as in solids_hulls.h
    // Direction d is in column (right d / ahead d) scale[0] + offset[0], and in a row alike.
    Vec3 right, up, ahead;
    std::array<float, 2> scale{}, offset{};
    int logCells = 0; // columns and rows
    // The picture shows nothing of what is farther from `ahead` than that.
    static constexpr float kLeastCosine = 0.25f;

    // lists[starts[cell]] up to the next kEnd: what the rays of a cell may meet, nearest first.
    // Each is the number of a hull, and above kHullBits the step from the lamp that it starts in.
    static constexpr int kHullBits = MappedShapes::kNumberBits;
    static constexpr std::uint32_t kEnd = 0xffffffffu; // behind all steps
    RawVector<std::uint32_t> starts, lists;
    float firstStep = 0, perStep = 0;

    float stepOf(float distance) const { return (distance - firstStep) * perStep; }
    std::size_t cells() const { return std::size_t{1} << logCells; }
};

// Null: the lamp is among the solids, or too near to have all of them in front of it.
std::shared_ptr<const LampMap> makeLampMap(std::shared_ptr<const MappedShapes> shapes, Vec3 lamp);
