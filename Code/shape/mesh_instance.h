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
#include <utility>
#include <vector>

// A mirror turns triangles over: then two corners change places, as in a copy (scene/merge.cpp).
inline TriangleCorners placedCorners(const Transform::Rows& sceneFromObject, bool mirrors,
                                     const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    TriangleCorners v{placedPoint(sceneFromObject, a), placedPoint(sceneFromObject, b),
                      placedPoint(sceneFromObject, c)};
    if (mirrors) std::swap(v[1], v[2]);
    return v;
}

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
    void surfaces(const SurfaceQuery& query, SurfacePlaces out) const override;
    SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const override;
    std::optional<TieOrder> tieOrder(const Ray& ray, const Hit& hit) const override;
    void forEachTriangle(TriangleFn fn) const override;
    const MeshInstance* meshInstance() const override { return this; }

    const MeshGeometry& geometry() const { return geometry_; }
    class Visit;

private:
    // Where the instance is at a time.
    struct Place {
        Transform::Rows sceneFromObject;
        bool mirrors;
        InstanceFilter filter;
        // Also for moved() by no more than `farthest` along an axis.
        Place(const MeshGeometry& geometry, const Transform& there, Vec3d farthest = {})
            : sceneFromObject(there.rows()), mirrors(there.mirrors()),
              filter(geometry, there, farthest) {}
        // As MovingTransform::at() moves a key.
        Place moved(Vec3d offset) const;
    };
    template <class Query> bool ask(const Ray& ray, Query&& query) const;
    RaySetup setupFor(const Ray& ray) const { return {ray.org, ray.dir, extent_}; }
    std::uint32_t materialOf(std::uint32_t triangle) const {
        return materials_[geometry_.slots.empty() ? 0 : geometry_.slots[triangle]];
    }
    Transform placeAt(float time) const { return motion_.at(static_cast<double>(time)); }
    Place placeOfKey(std::size_t key) const;
    const Place& atKey(std::size_t key) const {
        return key == 0 ? atFirstKey_ : atLaterKeys_[key - 1];
    }
    TriangleCorners corners(const Transform& sceneFromObject, std::uint32_t triangle) const;
    SurfaceTriangle surfaceTriangle(const Transform& sceneFromObject, std::uint32_t triangle) const;

    const MeshGeometry& geometry_;
    MovingTransform motion_; // sceneFromObject
    Place atFirstKey_;       // for good when it does not move: in one piece with the rest
    std::vector<Place> atLaterKeys_;
    std::vector<std::uint32_t> materials_;
    std::uint32_t object_;
    Bounds bounds_;
    float extent_ = kSceneExtent; // of what the corners are in the scene
};

// One ray at an instance, where that is at the ray's time: what finds candidates for the questions
// of triangle_queries.h, here or in a kernel.
class MeshInstance::Visit {
public:
    // `inScene`: the ray's setup with an extent, if it is known.
    struct KnownSetup {
        const RaySetup* setup;
        float extent;
    };
    Visit(const MeshInstance& instance, const Ray& ray, KnownSetup inScene = {nullptr, 0});
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

    const RaySetup& setup() const { return *setup_; } // in the scene
    // From corners as the object has them.
    TriangleCorners placed(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
        return placedCorners(place_->sceneFromObject, place_->mirrors, a, b, c);
    }
    // Nothing when no tree can tell: then every triangle is a candidate.
    const std::optional<TreeRay>& treeRay() const { return treeRay_; }
    // Depth in the tree behind which nothing is wanted.
    float treeCut(float zCut) const { return treeRay_->depthAt(zCut / setup_->dz); }
    TreeVisit inTree(float zCut) const {
        return treeRay_->visit(instance_.geometry_, treeCut(zCut));
    }
    // All of them but those that the ray is certain to miss before zCut.
    template <class LeafFn> void candidates(float zCut, LeafFn&& leaf) const;

private:
    const MeshInstance& instance_;
    std::optional<Place> moved_;
    const Place* place_;
    std::optional<RaySetup> ownSetup_;
    const RaySetup* setup_;
    std::optional<TreeRay> treeRay_;
};
