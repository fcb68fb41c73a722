// InstanceFilter: which triangles of an instance a ray of the scene may hit, found with the tree of
// the mesh's own space. It decides nothing: a hit is what the canonical test says of the corners in
// the scene, and this leaves out only what that test is certain to reject.
#pragma once

#include "accel/kernels/placed.h"
#include "accel/kernels/wide_walk.h"
#include "accel/triangle.h"
#include "shape/mesh_geometry.h"

#include <optional>

// A ray of the scene in the space of the tree. The parameter t is the same number in both.
class TreeRay {
public:
    // `depthPerSide`: how far before or behind its triangle the canonical hit may be, in the depth
    // of the setup, for each unit of the triangle's longest side.
    TreeRay(const MeshGeometry& mesh, const RaySetup& setup, float lateralError, double depthPerT,
            double depthPerSide);

    // Depth in the tree at t in the scene.
    float depthAt(float t) const {
        return static_cast<float>(min(static_cast<double>(t) * depthPerT_, 0x1p100));
    }
    // For the kernels.
    TreeVisit visit(const MeshGeometry& mesh, float zCut) const {
        return {.tree = &mesh.wide,
                .longestSide = longestSide_,
                .setup = &setup_,
                .exactPoints = mesh.leafPoints.data(),
                .depthPerSide = depthPerSide_,
                .lateralError = lateralError_,
                .zCut = zCut};
    }
    // traverse() of the mesh's tree, with as much room before the start of the ray and behind the
    // cut as the triangles of a node ask for.
    template <class LeafFn>
    void traverse(const MeshGeometry& mesh, float zCut, LeafFn&& leaf) const {
        const auto roomAt = [&](std::size_t line) { return longestSide_[line] * depthPerSide_; };
        ::traverse(mesh.wide, setup_, zCut, roomAt, leaf);
    }
    // May the triangle with these corners in the tree be hit? Woop's test with edge functions that
    // may be off: corners which are moved by up to d along each axis, at most m away from the ray,
    // change them by 4 d m.
    bool mayMeet(Vec3 v0, Vec3 v1, Vec3 v2) const {
        const Vec2 a = beside(v0), b = beside(v1), c = beside(v2);
        const float U = c.x * b.y - c.y * b.x, V = a.x * c.y - a.y * c.x;
        const float W = b.x * a.y - b.y * a.x;
        const float least = min(U, min(V, W)), most = max(U, max(V, W));
        if (!(least < 0 && most > 0)) return true;
        const auto size = [](Vec2 p) { return max(std::fabs(p.x), std::fabs(p.y)); };
        const float error = 5 * lateralError_ * max(size(a), max(size(b), size(c)));
        return !(least < -error && most > error);
    }

private:
    // From the ray to a point across the dominant axis; without its order of axes, which costs more
    // than the products with 0 and 1 here.
    Vec2 beside(Vec3 p) const { return {dot(acrossX_, p) + originX_, dot(acrossY_, p) + originY_}; }

    const float* longestSide_; // by line of the tree
    RaySetup setup_;
    Vec3 acrossX_, acrossY_;
    float originX_, originY_;
    float lateralError_; // of a corner relative to the ray, against what the canonical test sees
    float depthPerSide_;
    double depthPerT_;
};

class InstanceFilter {
public:
    // Also for moved() by no more than `farthest` along an axis.
    InstanceFilter(const MeshGeometry& mesh, const Transform& sceneFromObject, Vec3d farthest = {});
    // That of the same instance elsewhere in the scene.
    InstanceFilter moved(Vec3d offset) const;
    // `sceneExtent` is that of the canonical hit. Nothing when the tree can't tell, as the instance
    // is flat or tiny: then every triangle may be hit.
    std::optional<TreeRay> treeRay(const Ray& ray, float sceneExtent) const;

private:
    const MeshGeometry* mesh_;
    Transform::Rows treeFromScene_{};
    double stretch_ = 0; // most that a coordinate of the tree changes with those of the scene
    double own_ = 0;     // the part of the tree ray's extent that all rays have
    double longer_ = 0; // most that a side of a triangle becomes longer, along an axis of the scene
};
