// Shapes with a formula to try, placed anywhere, each beside its exact counterpart.
#pragma once

#include "shape/shape.h"
#include "verify/exact_shapes.h"
#include "verify/meshes.h"

#include <memory>
#include <string>

namespace battery {

struct Specimen {
    ObjectDesc object;
    Transform place;
    std::unique_ptr<const Shape> shape;
    ExactShape exact;

    Specimen(const ObjectDesc& what, const Transform& worldFromObject);
    // A point of the surface in the world; of a cone half of the time one near its tip, as close
    // as `nearest`, nor is a cap met that is smaller: a tip has no normal.
    Vec3d surfacePoint(meshes::Random& random, double nearest = 1e-6) const;
    // Is the place on the ray nearer to the axis of a cone than that?
    bool isNearTip(const Ray& ray, Wide t, double nearest) const;
    std::string text() const; // of its kind and place, for messages
};

// A shape of a random kind: all of unit size, and cones from pointed to cut.
ObjectDesc someShape(meshes::Random& random);

// A third of the maps only moves and scales by `size`, a third turns as well, a third stretches by
// up to 4 along the axes and may mirror. The shape's origin comes to lie at `centre`.
Transform somePlace(meshes::Random& random, double size, Vec3d centre);

// "from 1 2 3 along 4 5 6", with all digits.
std::string textOf(const Ray& ray);

} // namespace battery
