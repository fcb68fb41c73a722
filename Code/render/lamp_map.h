// LampMap: the solids that a point lamp sees in each direction, nearest first, so that most shadow
// rays need no walk through the tree (Haines and Greenberg, "The Light Buffer", IEEE CG&A 6, 1986).
// Directions are the cells of a picture that the lamp takes of the solids. What the map says is
// sure; where it can't tell, a ray has to be asked.
#pragma once

#include "accel/kernels/kernels.h"
#include "base/raw_vector.h"
#include "light/point_emission.h"
#include "render/occluders.h"
#include "render/waves/lamp_lanes.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// The shapes of a scene as all maps of its lamps know them.
struct MappedShapes {
    // What is known of a solid, in half a line of the cache: RoundHull.
    struct alignas(32) Hull {
        Vec3 centre;
        float radius; // negative: no inner one is known; else that is kInner of it
        Vec3 axis;
        float halfLength; // 0: a ball
    };
    static constexpr float kInner = 1 - 0x1p-17f;
    static constexpr std::uint32_t kNoHull = 0xffffffffu;
    static constexpr std::size_t kMostOthers = 4;

    RawVector<Hull> hulls;
    // By the number of the shape: what does not hide it from a lamp on its outside.
    std::vector<std::uint32_t> hullOf;
    Bounds box;                   // of the shapes with a hull
    std::vector<Occluder> others; // the shapes without
    float extent = 0;             // see ShapeSet

    // Nothing: a map would not pay, or shapes move.
    static std::optional<MappedShapes> of(const ShapeSet& shapes);
};

struct LampMap {
    std::shared_ptr<const MappedShapes> shapes;
    std::vector<Occluder> others; // what hides what from this lamp
    Vec3 lamp;
    float slack = 0; // that covers rounding, as in solids_hulls.inl
    // Direction d is in column (right d / ahead d) scale[0] + offset[0], and in a row alike.
    Vec3 right, up, ahead;
    std::array<float, 2> scale{}, offset{};
    int logCells = 0; // columns and rows
    // The picture shows nothing of what is farther from `ahead` than that.
    static constexpr float kLeastCosine = 0.25f;

    // lists[starts[cell]] up to starts[cell + 1]: what the rays of a cell may meet, nearest first.
    // Each is the number of a hull, and above kHullBits the step from the lamp that it starts in.
    static constexpr int kHullBits = 20;
    RawVector<std::uint32_t> starts, lists;
    float firstStep = 0, perStep = 0;

    float stepOf(float distance) const { return (distance - firstStep) * perStep; }
    std::size_t cells() const { return std::size_t{1} << logCells; }
};

// Null: the lamp is among the solids, or too near to have all of them in front of it.
std::shared_ptr<const LampMap> makeLampMap(std::shared_ptr<const MappedShapes> shapes, Vec3 lamp);

// Looks for the points of blocks that are `unsure`: those that something hides from the lamp are no
// longer lit, and unsure are those of which only a ray can tell.
using AskLampMapFn = void (*)(const LampMap& map, std::span<const LitBlock> blocks,
                              std::span<LitByLamp> by);
// Null for the scalar kernel.
AskLampMapFn askLampMap(const Kernel& kernel);
