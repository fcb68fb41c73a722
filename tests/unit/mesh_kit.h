// What the tests of meshes share: a ray to a point, and a mesh that is known by formula.
#pragma once

#include "base/ray.h"
#include "desc/scene_desc.h"

namespace mesh_kit {

inline Ray rayTo(Vec3d from, Vec3d to) {
    Ray ray;
    ray.org = toFloat(from);
    ray.dir = toFloat(to) - ray.org;
    return ray;
}

// The four corner values of a mesh that tests interpolation: all coordinates known by formula.
inline MeshDesc squareWithUvs() {
    MeshDesc mesh;
    mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.uvs = {{0.25f, 0.5f}, {0.75f, 0.5f}, {0.75f, 1}, {0.25f, 1}};
    mesh.uvTriangles = mesh.triangles;
    return mesh;
}

} // namespace mesh_kit
