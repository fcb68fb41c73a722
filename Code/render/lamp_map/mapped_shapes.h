// MappedShapes: what the maps of lamps (lamp_map.h) show of a scene's shapes.
#pragma once

#include "base/raw_vector.h"
#include "render/occluders.h"

#include <cstdint>
#include <optional>
#include <vector>

// The shapes of a scene as all maps of its lamps know them.
struct MappedShapes {
    // What is known of a solid, in half a line of the cache: RoundHull.
    struct alignas(32) Hull {
        Vec3 centre;
        float radius;
        Vec3 axis;
        float halfLength; // 0: a ball
    };
    // Of a radius: what comes so near to the middle of a filled hull meets the shape.
    static constexpr float kInner = 1 - 0x1p-17f;
    static constexpr std::uint32_t kNoHull = 0xffffffffu;
    static constexpr int kNumberBits = 20; // of the number of a hull
    static constexpr std::size_t kMostOthers = 4;

    RawVector<Hull> hulls; // filled balls, then the others: tubes, and balls with air in them
    std::uint32_t firstOther = 0;
    // Of the others, if not all are filled tubes: of a ball or a tube within. What comes into it
    // from outside of the hull, and by no end, meets the shape.
    RawVector<float> cores;
    // By the number of the shape: what does not hide it from a lamp on its outside.
    std::vector<std::uint32_t> hullOf;
    Bounds box;                   // of the shapes with a hull
    std::vector<Occluder> others; // the shapes without
    float extent = 0;             // see ShapeSet

    // Nothing: a map would not pay, or shapes move.
    static std::optional<MappedShapes> of(const ShapeSet& shapes);
};
