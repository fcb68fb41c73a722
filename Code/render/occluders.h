// Occluders: whether anything can be in between some points and a lamp, from the boxes of the
// shapes that cast shadows. Where nothing can, no shadow rays are needed.
#pragma once

#include "render/shape_set.h"

class Occluders {
public:
    explicit Occluders(const ShapeSet& shapes);

    // Can a shape be in between a place in `points`, all on `shape`, and a place in `lamp`, seen
    // from the outside of that shape or from its inside? True says nothing.
    bool mayHide(const Bounds& points, std::uint32_t shape, bool fromInside,
                 const Bounds& lamp) const;
    // False: there are too many shapes to look at.
    bool canTell() const { return canTell_; }

private:
    struct Caster {
        std::uint32_t shape;
        Bounds box;
    };
    const ShapeSet& shapes_;
    bool canTell_;
    std::vector<Caster> casters_;
};
