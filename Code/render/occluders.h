// Occluders: whether anything can be in between some points and a lamp, from the boxes of the
// shapes that cast shadows. Where nothing can, no shadow rays are needed.
#pragma once

#include "render/shape_set.h"

#include <optional>
#include <span>

// A shape that casts shadows, as who looks for what can't be hidden sees it.
struct Occluder {
    // Where n.p + offset has one sign for a point and all of a lamp, a plane is not in between.
    struct Sides {
        Vec3 n; // unit
        float offset;
    };
    std::uint32_t shape;
    bool hidesOutside, hidesInside; // from itself
    Bounds box;
    std::optional<Sides> plane; // without end, and so is its box
    // Of a sphere, which is nearly all of it; else infinite.
    Vec3 centre{};
    float radius = kInfinityF;
    float core = 0; // radius of a ball about the centre that no light passes; 0: none is known
    bool fillsBox = false; // a cube that does, and no light passes
};

Occluder occluderOf(const ShapeSet& shapes, std::uint32_t number);

class Occluders {
public:
    // Looking at more boxes than these costs more than it saves.
    static constexpr std::size_t kMost = 16;

    explicit Occluders(const ShapeSet& shapes);

    // Can a shape be in between a place in `points`, all on `shape`, and a place in `lamp`, seen
    // from the outside of that shape or from its inside? True says nothing. `isAtInfinity`: lines
    // go on behind their places in `lamp`, where nothing is but what is endless.
    bool mayHide(const Bounds& points, std::uint32_t shape, bool fromInside, const Bounds& lamp,
                 bool isAtInfinity = false) const;
    // False: there are too many shapes to look at; then the other questions have no answer.
    bool canTell() const { return canTell_; }

    // Are they few, and none of them a mesh? Then what is said of them does not depend on how the
    // scene is built: meshes may be merged.
    bool areSolids() const { return areSolids_; }

    // For who looks at many points at once: all of them, and how far from them what is said to pass
    // by has to stay, of the coordinates of points, lamps, and boxes. Rays are rounded to 2^-24
    // of their coordinates, start some 2^-20 off the points, and a shape may be met 2^-20 off its
    // box.
    std::span<const Occluder> all() const { return casters_; }
    static constexpr float kSlack = 0x1p-16f;
    float extent() const { return shapes_.extent; }
    // No |coordinate| of the box of a shape that casts shadows is larger, but for what is endless.
    float reach() const { return reach_; }

private:
    const ShapeSet& shapes_;
    bool canTell_, areSolids_;
    float reach_ = 0;
    std::vector<Occluder> casters_;
};
