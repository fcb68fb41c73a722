// Sets of triangles that are hard on builders of trees.
#pragma once

#include "verify/meshes.h"

namespace battery {

using Triangles = std::vector<std::array<Vec3, 3>>;

struct HostileTree {
    const char* name;
    Triangles (*make)(meshes::Random&, std::size_t count);
};
std::span<const HostileTree> hostileTrees();

// As many triangles as hostile ones, of a scanned surface as far as a tree can tell: small ones,
// even, on a ball.
Triangles evenTriangles(meshes::Random& random, std::size_t count);

} // namespace battery
