// MeshGeometry: the data of a triangle mesh with the tree over it, in one space. Plain lists; the
// shapes made of it are Mesh (mesh.h), which is traced as it is, and MeshInstance.
#pragma once

#include "accel/kernels/kernels.h"
#include "base/raw_vector.h"
#include "base/transform.h"

#include <array>
#include <cstdint>
#include <vector>

// What stands still in a scene is within [-1,1] (scene/frame.h). The pads of the canonical hit
// follow from that, not from the points of one mesh: how a scene is cut into meshes must not show.
inline constexpr float kSceneExtent = 1;

// Where a corner and its normal come to lie in the scene. A mesh that is copied into the scene and
// an instance of it both ask here, so that they are the same to the last bit.
inline Vec3 placedPoint(const Transform::Rows& sceneFromObject, Vec3d p) {
    const Transform::Rows& m = sceneFromObject;
    return toFloat(Vec3d{m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                         m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                         m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]});
}
inline Vec3 placedPoint(const Transform& sceneFromObject, Vec3d p) {
    return placedPoint(sceneFromObject.rows(), p);
}
inline Vec3 placedNormal(const Transform& sceneFromObject, Vec3 n) {
    const Vec3d normal = sceneFromObject.normal(toDouble(n));
    const double length2 = dot(normal, normal);
    return length2 > 0 ? toFloat(normal / std::sqrt(length2)) : Vec3{};
}

struct MeshGeometry {
    using Corners = std::array<std::uint32_t, 3>;
    // Corners of a triangle that has no normals or coordinates, where others have.
    static constexpr Corners kWithout{0xffffffffu, 0xffffffffu, 0xffffffffu};

    RawVector<Vec3> points;       // in the space of the tree
    RawVector<Corners> triangles; // counter-clockwise seen from outside
    RawVector<Vec3> normals;      // with corner indices of their own; may be empty
    RawVector<Corners> normalTriangles;
    RawVector<Vec2> uvs;
    RawVector<Corners> uvTriangles;
    RawVector<std::uint32_t> slots; // material slot per triangle; empty: all 0

    // Of a mesh for instances: its points as they are in the object, of which each instance makes
    // those of the scene; `points` are theirs, rounded in the space of the tree. Else empty.
    RawVector<Vec3d> exactPoints;
    Transform treeFromObject; // moves and scales, alike along all axes
    BoundsD exactBox;         // of the exact points
    // By line of the nodes and leaves of the tree: of the exact triangles below.
    std::vector<float> longestSide;

    // Copies of the exact points for the leaves of the tree; see TreeVisit::exactPoints.
    ZeroedVector<Vec3d> leafPoints;

    WideTree wide;               // empty: every triangle is tested (--accel none)
    const Isa* isa = nullptr;    // answers batches; null: the scalar code does
    float extent = kSceneExtent; // no |coordinate| of a point is larger
    Bounds box;                  // of the triangles

    // Takes triangles with two corners in one place out of the lists: no ray meets them. Returns
    // how many have no area. Those with three corners on a line stay: to a ray, whose arithmetic
    // rounds each corner by itself, such a triangle closes the gap between its neighbours.
    std::uint64_t dropDegenerate(int threads = 1);
    // Triangles with a corner at NaN or infinity become points, which no ray meets.
    void collapseEndless();
    // Does that, computes extent, boxes, what is said of the exact points and, if wanted, the tree
    // that the kernel needs, for which points that are the same become one (share_points.h). The
    // same for any number of threads. The lists do not change afterwards.
    void finish(bool withTree, const Isa& forIsa = oneLane(), int threads = 1);
    bool hasTree() const { return !wide.isEmpty(); }
    WideMesh wideMesh() const { return {wide, points, triangles, extent}; }
    std::size_t bytes() const;

private:
    void measure(int threads);
};
