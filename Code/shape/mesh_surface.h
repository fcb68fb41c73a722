// The point of a hit on a triangle: where rays leave it, its normals, its texture coordinates. Of a
// merged mesh and of an instance alike, in the scene's space.
#pragma once

#include "shape/mesh_geometry.h"
#include "shape/shape.h"
#include "shape/triangle_queries.h"

struct SurfaceTriangle {
    TriangleCorners corners;
    bool hasNormals = false, hasUvs = false;
    std::array<Vec3, 3> normals{};
    std::array<Vec2, 3> uvs{};

    // Normals and, if needed, coordinates as the lists have them.
    SurfaceTriangle(const MeshGeometry& geometry, std::uint32_t triangle,
                    const TriangleCorners& placed, SurfaceNeeds needs = {});
};

// All but the material and the object.
Surface surfaceOf(const SurfaceTriangle& triangle, const Ray& ray, const Hit& hit,
                  SurfaceNeeds needs);
SurfaceDerivatives derivativesOf(const SurfaceTriangle& triangle);
