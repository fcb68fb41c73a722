// MeshInstance: a mesh that several objects share, or that moves. Its hits are to the last bit
// those of a Mesh with the same points placed in the scene, so that borders between instances do
// not leak and it cannot be seen which of the two a renderer has chosen. Only the search differs:
// it goes through the tree of the shared mesh (instance_filter.h).
#pragma once

#include "base/motion.h"
#include "shape/instance_filter.h"
#include "shape/mesh_geometry.h"
#include "shape/mesh_surface.h"
#include "shape/shape.h"

#include <cstdint>
#include <vector>

class MeshInstance final : public Shape {
public:
    // `materials` by slot. The geometry, which has exact points, must outlive the shape.
    MeshInstance(const MeshGeometry& geometry, MovingTransform sceneFromObject,
                 std::vector<std::uint32_t> materials, std::uint32_t object);

    Bounds bounds() const override { return bounds_; }
    bool intersect(const Ray& ray, Hit& hit) const override;
    bool occludes(const Ray& ray) const override;
    void collect(const Ray& ray, std::vector<Hit>& hits) const override;
    Surface surface(const Ray& ray, const Hit& hit) const override {
        return surfaceFor(ray, hit, {});
    }
    Surface surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const override;
    SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const override;
    std::optional<TieOrder> tieOrder(const Ray& ray, const Hit& hit) const override;

private:
    // Where the instance is at a time.
    struct Place {
        Transform sceneFromObject;
        InstanceFilter filter;
        Place(const MeshGeometry& geometry, const Transform& there)
            : sceneFromObject(there), filter(geometry, there) {}
    };
    template <class Query> bool ask(const Ray& ray, float tMax, Query&& query) const;
    template <class LeafFn>
    void candidates(const Transform& sceneFromObject, const std::optional<TreeRay>& treeRay,
                    const RaySetup& setup, float zCut, LeafFn&& leaf) const;
    RaySetup setupFor(const Ray& ray) const { return {ray.org, ray.dir, extent_}; }
    Transform placeAt(float time) const { return motion_.at(static_cast<double>(time)); }
    TriangleCorners corners(const Transform& sceneFromObject, std::uint32_t triangle) const;
    SurfaceTriangle surfaceTriangle(const Transform& sceneFromObject, std::uint32_t triangle) const;

    const MeshGeometry& geometry_;
    MovingTransform motion_; // sceneFromObject
    Place still_;            // when it does not move
    std::vector<std::uint32_t> materials_;
    std::uint32_t object_;
    Bounds bounds_;
    float extent_ = kSceneExtent; // of what the corners are in the scene
};
