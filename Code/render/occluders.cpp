#include "render/occluders.h"

namespace {

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

// Are all of both boxes on one side of the plane? With `goesOn`, also all of the lines from one to
// the other behind it: they do not come nearer to the plane.
bool areBeside(const Occluder::Sides& plane, const Bounds& from, const Bounds& to, float slack,
               bool goesOn) {
    struct Heights {
        float middle, reach;
        int side() const { return middle > reach ? 1 : middle < -reach ? -1 : 0; }
    };
    const auto heights = [&](const Bounds& box) {
        const Vec3 middle = (box.lo + box.hi) * 0.5f, half = (box.hi - box.lo) * 0.5f;
        return Heights{dot(plane.n, middle) + plane.offset,
                       std::fabs(plane.n.x) * half.x + std::fabs(plane.n.y) * half.y +
                           std::fabs(plane.n.z) * half.z + slack};
    };
    const Heights a = heights(from), b = heights(to);
    const int side = a.side();
    if (side == 0 || side != b.side()) return false;
    const float most = max(std::fabs(b.middle), std::fabs(a.middle)) * 0x1p-20f + slack;
    return !goesOn || static_cast<float>(side) * (b.middle - a.middle) >= b.reach - a.reach + most;
}

std::optional<Occluder::Sides> sidesOf(const Shape& shape, const Bounds& box) {
    if (box.isFinite()) return {};
    const SolidForm form = shape.solidForm();
    if (!form.faces || form.motion || form.faces->side != Facets::Side::Both) return {};
    const auto& m = form.faces->shape->objectFromWorld();
    const Vec3d n{m[8], m[9], m[10]};
    const double size = length(n);
    if (!(size > 0x1p-100 && size < 0x1p100)) return {};
    return Occluder::Sides{toFloat(n / size), static_cast<float>(m[11] / size)};
}

// A cube whose faces are those of its box, and not too slim to be met (Cube::solidForm()).
bool isUpright(const SolidForm& form) {
    if (!form.faces || form.faces->of != StillFaces::Of::Cube || form.motion) return false;
    const auto& m = form.faces->shape->objectFromWorld();
    for (std::size_t row = 0; row < 12; row += 4)
        if ((m[row] != 0) + (m[row + 1] != 0) + (m[row + 2] != 0) != 1) return false;
    return form.hull.innerRadius > 0 && form.faces->side == Facets::Side::Both;
}

} // namespace

Occluder occluderOf(const ShapeSet& shapes, std::uint32_t number) {
    const Shape& shape = *shapes.shapes[number];
    Occluder caster{number, shape.hidesFromItself(false), shape.hidesFromItself(true),
                    shapes.boxes[number], sidesOf(shape, shapes.boxes[number])};
    const SolidForm form = shape.solidForm();
    const bool isOpaque = shapes.shadows[number] == ShapeSet::Shadow::Opaque;
    caster.fillsBox = isOpaque && isUpright(form);
    if (form.sphere) {
        caster.centre = toFloat(form.hull.centre);
        caster.radius = floatAbove(form.hull.radius * (1 + 0x1p-20));
        if (isOpaque) caster.core = floatBelow(form.hull.innerRadius * (1 - 0x1p-20));
    }
    return caster;
}

Occluders::Occluders(const ShapeSet& shapes) : shapes_(shapes) {
    std::size_t count = 0;
    const auto casts = [&](std::size_t i) {
        return shapes.shadows[i] != ShapeSet::Shadow::None && !shapes.boxes[i].isEmpty();
    };
    for (std::size_t i = 0; i < shapes.shapes.size(); ++i) count += casts(i);
    canTell_ = areSolids_ = count <= kMost;
    if (!canTell_) return;
    for (std::uint32_t i = 0; i < shapes.shapes.size(); ++i) {
        if (!casts(i)) continue;
        casters_.push_back(occluderOf(shapes, i));
        areSolids_ &= !shapes.shapes[i]->isOfTriangles();
        const Bounds& box = shapes.boxes[i];
        if (box.isFinite()) reach_ = max(max(maxAbs(box.lo), maxAbs(box.hi)), reach_);
    }
}

bool Occluders::mayHide(const Bounds& points, std::uint32_t shape, bool fromInside,
                        const Bounds& lamp, bool isAtInfinity) const {
    const float margin = kSlack * max(max(max(maxAbs(points.lo), maxAbs(points.hi)),
                                          max(maxAbs(lamp.lo), maxAbs(lamp.hi))),
                                      extent());
    for (const Occluder& caster : casters_) {
        if (caster.shape == shape && !(fromInside ? caster.hidesInside : caster.hidesOutside))
            continue;
        if (caster.plane && areBeside(*caster.plane, points, lamp, margin, isAtInfinity)) continue;
        if (sweepMeets(points, lamp, caster.box, margin)) return true;
    }
    return false;
}
