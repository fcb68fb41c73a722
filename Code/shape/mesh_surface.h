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

// surfaceOf() of a block of hits by the lanes of a kernel: put(), find(), take().
class TriangleSurfaceBatch {
public:
    static constexpr std::size_t kHits = TrianglesMet::kHits;
    TriangleSurfaceBatch(TriangleSurfacesFn fn, SurfaceNeeds needs) : fn_(fn) {
        met_.wantsLift = needs.lift;
    }
    void clear() { met_.used = met_.smooth = 0; }
    void put(std::size_t lane, const SurfaceTriangle& triangle, const Hit& hit, Vec3 dir);
    void find() { fn_(met_, found_); }
    // Else it has to be asked by itself.
    bool knows(std::size_t lane) const { return (found_.unknown >> lane & 1) == 0; }
    Surface take(std::size_t lane) const;

private:
    TriangleSurfacesFn fn_;
    TrianglesMet met_;
    TriangleSurfaces found_;
    std::array<Vec2, kHits> uv_;
};

// The same of all hits of a query. triangleOf(hit) is the SurfaceTriangle.
template <class TriangleFn>
void surfacesOf(const SurfaceQuery& query, TriangleFn&& triangleOf, Strided<Surface> out) {
    TriangleSurfaceBatch batch(query.lanes.triangles, query.needs);
    constexpr std::size_t kHits = TriangleSurfaceBatch::kHits;
    for (std::size_t first = 0; first < query.which.size(); first += kHits) {
        const std::size_t count = min(query.which.size() - first, kHits);
        const auto rays = query.which.subspan(first, count), to = query.to.subspan(first, count);
        batch.clear();
        for (std::size_t i = 0; i < count; ++i)
            batch.put(i, triangleOf(query.hits[rays[i]]), query.hits[rays[i]],
                      query.rays.dir[rays[i]]);
        batch.find();
        for (std::size_t i = 0; i < count; ++i) {
            const Hit& hit = query.hits[rays[i]];
            out[to[i]] = batch.knows(i)
                             ? batch.take(i)
                             : surfaceOf(triangleOf(hit), query.rays[rays[i]], hit, query.needs);
        }
    }
}

SurfaceDerivatives derivativesOf(const SurfaceTriangle& triangle);
