// Mesh: triangles that lie in the scene's space and stand still, one mesh or many that were merged.
// Traversal uses the canonical triangle hit (accel/triangle.h): one ray sees one set of vertex bits
// and closed meshes cannot leak. Batches of rays go to the vector kernels.
#pragma once

#include "shape/mesh_geometry.h"
#include "shape/shape.h"
#include "shape/triangle_queries.h"

#include <cstdint>
#include <vector>

// A run of triangles of a Mesh that came from one object: for object ids after meshes were merged.
struct MeshPart {
    std::uint32_t firstTriangle = 0;
    std::uint32_t object = 0;
};

struct SurfaceTriangle;

class Mesh final : public Shape {
public:
    // `materials` by slot, `parts` in ascending order, the first starting at triangle 0.
    // The geometry is finished, and must outlive the shape.
    Mesh(const MeshGeometry& geometry, std::vector<std::uint32_t> materials,
         std::vector<MeshPart> parts);

    Bounds bounds() const override { return geometry_.box; }
    bool intersect(const Ray& ray, Hit& hit) const override;
    bool occludes(const Ray& ray) const override;
    void collect(const Ray& ray, std::vector<Hit>& hits) const override;
    bool takesBatches() const override { return geometry_.isa != nullptr; }
    void intersectBatch(const RaySpan& rays, std::uint32_t number,
                        std::span<Hit> hits) const override;
    void occludesBatch(const RaySpan& rays, std::span<std::uint8_t> hidden) const override;
    SolidForm solidForm() const override;
    bool seesFront(const Ray& ray, const Hit& hit) const override;
    Surface surface(const Ray& ray, const Hit& hit) const override {
        return surfaceFor(ray, hit, {});
    }
    Surface surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const override;
    void surfaces(const SurfaceQuery& query, SurfacePlaces out) const override;
    SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const override;
    std::optional<TieOrder> tieOrder(const Ray& ray, const Hit& hit) const override;
    void forEachTriangle(TriangleFn fn) const override;

private:
    RaySetup setupFor(const Ray& ray) const { return {ray.org, ray.dir, geometry_.extent}; }
    TriangleCorners corners(std::uint32_t triangle) const {
        const auto& c = geometry_.triangles[triangle];
        return {geometry_.points[c[0]], geometry_.points[c[1]], geometry_.points[c[2]]};
    }
    SurfaceTriangle surfaceTriangle(std::uint32_t triangle, SurfaceNeeds needs) const;
    template <class LeafFn> void candidates(const RaySetup& setup, float zCut, LeafFn&& leaf) const;
    std::uint32_t materialOf(std::uint32_t triangle) const {
        return materials_[geometry_.slots.empty() ? 0 : geometry_.slots[triangle]];
    }
    std::uint32_t objectOf(std::uint32_t triangle) const;

    const MeshGeometry& geometry_;
    std::vector<std::uint32_t> materials_;
    std::vector<MeshPart> parts_;
};
