// InstanceFilter: which triangles of an instance a ray of the scene may hit, found with the tree of
// the mesh's own space. It decides nothing: a hit is what the canonical test says of the corners in
// the scene, and this leaves out only what that test is certain to reject.
#pragma once

#include "shape/mesh_geometry.h"

#include <optional>

// A ray of the scene in the space of the tree, with the depths of that space.
class TreeRay {
public:
    TreeRay(const RaySetup& setup, float lateralError, double depthPerZ, double depthMore)
        : setup_(setup), lateralError_(lateralError), depthPerZ_(depthPerZ), depthMore_(depthMore) {
    }
    const RaySetup& setup() const { return setup_; }
    // The depth in the tree behind which no triangle is hit in front of the depth z in the scene.
    float cut(float z) const {
        return static_cast<float>(min(z * depthPerZ_ + depthMore_, 0x1p100));
    }
    // May the triangle with these corners in the tree be hit?
    bool mayMeet(Vec3 v0, Vec3 v1, Vec3 v2) const;

private:
    RaySetup setup_;
    float lateralError_; // of a corner relative to the ray, against what the canonical test sees
    double depthPerZ_, depthMore_;
};

class InstanceFilter {
public:
    InstanceFilter(const MeshGeometry& geometry, const Transform& sceneFromObject);
    // `scene` is the setup of the ray, and `sceneExtent` that of the setup. Nothing when the tree
    // can't tell, as the instance is flat or tiny: then every triangle may be hit.
    std::optional<TreeRay> treeRay(const Ray& ray, const RaySetup& scene, float sceneExtent) const;

private:
    Transform treeFromScene_;
    double stretch_ = 0; // most that a coordinate of the tree changes with those of the scene
    double own_ = 0;     // the part of the tree ray's extent that all rays have
    Vec3d reach_;        // no triangle extends farther along an axis of the scene
};
