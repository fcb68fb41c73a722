// Triangle meshes: MeshGeometry is the data, shared by all instances; Mesh is the Shape that puts
// it into the world. Traversal uses the canonical triangle hit (accel/triangle.h) in the geometry's
// own float space, so one ray sees one set of vertex bits and closed meshes cannot leak.
#pragma once

#include "accel/bvh.h"
#include "accel/kernels/kernels.h"
#include "base/motion.h"
#include "shape/shape.h"

#include <array>
#include <cstdint>
#include <vector>

struct MeshGeometry {
    using Corners = std::array<std::uint32_t, 3>;
    std::vector<Vec3> points;
    std::vector<Corners> triangles; // counter-clockwise seen from outside
    std::vector<Vec3> normals;      // with corner indices of their own; may be empty
    std::vector<Corners> normalTriangles;
    std::vector<Vec2> uvs;
    std::vector<Corners> uvTriangles;
    std::vector<std::uint32_t> slots; // material slot per triangle; empty: all 0
    // At most one of the trees; both empty: every triangle is tested (--accel none).
    Bvh bvh;
    WideTree wide;                  // for the kernel
    const Kernel* kernel = nullptr; // answers batches; null: the scalar code does
    float extent = 0;               // largest |coordinate| of a point

    // Takes triangles with two corners in one place out of the lists, and returns how many have no
    // area. Those with three corners on a line stay: to a ray, whose arithmetic rounds each corner
    // by itself, such a triangle closes the gap between its neighbours.
    std::uint64_t dropDegenerate();
    // Triangles with a corner at NaN or infinity become points, which no ray meets.
    void collapseEndless();
    // Does that, computes extent and, if wanted, the tree that the kernel needs, the same for any
    // number of threads. The lists do not change afterwards.
    void finish(bool withTree, const Kernel& forKernel = chooseKernel("scalar"), int threads = 1);
    WideMesh wideMesh() const { return {wide, points, triangles, extent}; }
    std::size_t bytes() const;
};

// A run of triangles of a Mesh that came from one object: for object ids after meshes were merged.
struct MeshPart {
    std::uint32_t firstTriangle = 0;
    std::uint32_t object = 0;
};

class Mesh final : public Shape {
public:
    // `materials` by slot, `parts` in ascending order, the first starting at triangle 0.
    // The geometry must outlive the shape. `objectFromMesh` takes the geometry's frame to that of
    // the object, about whose origin a moving object turns.
    Mesh(const MeshGeometry& geometry, MovingTransform worldFromObject,
         std::vector<std::uint32_t> materials, std::vector<MeshPart> parts,
         const Transform& objectFromMesh = {});

    Bounds bounds() const override;
    bool intersect(const Ray& ray, Hit& hit) const override;
    bool occludes(const Ray& ray) const override;
    void collect(const Ray& ray, std::vector<Hit>& hits) const override;
    bool takesBatches() const override { return identity_ && geometry_.kernel != nullptr; }
    void intersectBatch(const RaySpan& rays, std::uint32_t number,
                        std::span<Hit> hits) const override;
    void occludesBatch(const RaySpan& rays, std::span<std::uint8_t> hidden) const override;
    bool seesFront(const Ray& ray, const Hit& hit) const override;
    Surface surface(const Ray& ray, const Hit& hit) const override {
        return surfaceFor(ray, hit, {});
    }
    Surface surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const override;
    SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const override;

private:
    Ray meshRay(const Ray& worldRay) const;
    Transform worldFromMeshAt(float time) const;
    template <class LeafFn>
    void forEachTriangle(const RaySetup& setup, float zCut, LeafFn&& leaf) const;
    float keyOf(const RaySetup& setup, std::uint32_t triangle) const;

    const MeshGeometry& geometry_;
    MovingTransform worldFromObject_;
    Transform objectFromMesh_;
    Transform worldFromMesh_, meshFromWorld_; // when it does not move
    bool identity_;                           // the geometry is in world space already
    std::vector<std::uint32_t> materials_;
    std::vector<MeshPart> parts_;
    Bounds bounds_;
};
