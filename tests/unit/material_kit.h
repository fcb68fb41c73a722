// Directions about a surface whose normal is +z, for the tests of materials.
#pragma once

#include "base/math.h"
#include "verify/meshes.h"

#include <cmath>

namespace material_kit {

inline constexpr Vec3 kUp{0, 0, 1};

inline Vec3 atAngle(double angle) {
    return {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
}
inline Vec3 above(meshes::Random& random) {
    Vec3d d = random.direction();
    d.z = std::fabs(d.z);
    return toFloat(d);
}

} // namespace material_kit
