#include "render/occluders.h"

namespace {

// Looking at more boxes than these costs more than it saves.
constexpr std::size_t kMostCasters = 16;

// The part of [0,1] where linear functions a + t b are not negative, after some of them.
struct Times {
    float lo = 0, hi = 1;
    void keepPositive(float a, float b) {
        if (b > 0)
            lo = max(-a / b, lo);
        else if (b < 0)
            hi = min(a / -b, hi);
        else if (a < 0)
            lo = 2;
    }
};

// Every line from a place in `from` to one in `to` is, after the part t of its way, in the box that
// lies the part t between both. Does that meet `box` at any t?
bool sweepMeets(const Bounds& from, const Bounds& to, const Bounds& box, float slack) {
    Times times;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        times.keepPositive(from.hi[axis] - box.lo[axis] + slack, to.hi[axis] - from.hi[axis]);
        times.keepPositive(box.hi[axis] - from.lo[axis] + slack, from.lo[axis] - to.lo[axis]);
    }
    return !(times.lo > times.hi * (1 + 0x1p-18f));
}

} // namespace

Occluders::Occluders(const ShapeSet& shapes) : shapes_(shapes) {
    for (std::uint32_t i = 0; i < shapes.shapes.size(); ++i)
        if (shapes.shadows[i] != ShapeSet::Shadow::None && !shapes.boxes[i].isEmpty())
            casters_.push_back({i, shapes.boxes[i]});
    canTell_ = casters_.size() <= kMostCasters;
}

bool Occluders::mayHide(const Bounds& points, std::uint32_t shape, bool fromInside,
                        const Bounds& lamp) const {
    // Rays are rounded to 2^-24 of their coordinates, start some 2^-20 off the points, and a shape
    // may be met 2^-20 off its box.
    const float extent = max(shapes_.extent, max(max(maxAbs(points.lo), maxAbs(points.hi)),
                                                 max(maxAbs(lamp.lo), maxAbs(lamp.hi))));
    for (const Caster& caster : casters_) {
        if (caster.shape == shape && !shapes_.shapes[shape]->hidesFromItself(fromInside)) continue;
        if (sweepMeets(points, lamp, caster.box, 0x1p-16f * extent)) return true;
    }
    return false;
}
