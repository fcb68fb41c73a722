// The shapes with a formula, one of each kind: what the battery and the unit tests put to the test.
// A new shape joins the list in shape_kinds.cpp.
#pragma once

#include "base/motion.h"
#include "shape/plane.h"
#include "shape/shape.h"
#include "verify/meshes.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace kit {

// rim() gives points that reach every side of the shape's smallest box.
struct Kind {
    std::string name;
    bool isClosed, isFlat;
    std::function<std::unique_ptr<Shape>(const MovingTransform&)> make;
    std::function<Vec3d(meshes::Random&)> rim;
};
const std::vector<Kind>& kinds();
const Kind& kindNamed(const std::string& name);

Vec3d onCircle(meshes::Random& random, double radius, double z);
inline const Plane::Corners kQuad = {Vec3d{-1, -1, 0.25}, Vec3d{1, -0.5, 0.25},
                                     Vec3d{0.75, 1, 0.25}, Vec3d{-0.5, 0.75, 0.25}};

// Turn, scale along the axes by the factors (which may mirror), turn, move.
Transform placed(meshes::Random& random, Vec3d factors, Vec3d offset);
// Factors of condition <= 1e4 about `size`, mirrored half the time.
Vec3d randomFactors(meshes::Random& random, double size);

inline Ray rayFrom(Vec3d org, Vec3d dir) { return {toFloat(org), toFloat(dir)}; }
inline Ray rayThrough(Vec3d org, Vec3d target) {
    return rayFrom(org, normalize(target - toDouble(toFloat(org))));
}

} // namespace kit
