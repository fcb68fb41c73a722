// The triangles of a mesh as those who smooth it look at them: normals, angles, and which corners
// meet in a point.
#pragma once

#include "desc/scene_desc.h"

#include <array>
#include <cstdint>
#include <vector>

struct TriangleShape {
    Vec3d normal; // unit; zero for a triangle without area, so that it has no weight
    std::array<double, 3> angle{};
};
std::vector<TriangleShape> triangleShapes(const MeshDesc& mesh, int threads);

// The corners of all triangles in the order of their points, by counting: those of point i are
// [starts[i], starts[i + 1]) of `corners`, numbered 3 * triangle + corner.
struct CornersByPoint {
    std::vector<std::uint32_t> starts, corners;

    explicit CornersByPoint(const MeshDesc& mesh);
};
