#include "shape/mesh.h"

#include "accel/triangle.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace {

Vec3d crossOfEdges(Vec3 v0, Vec3 v1, Vec3 v2) {
    return cross(toDouble(v1) - toDouble(v0), toDouble(v2) - toDouble(v0));
}

// Which hits count. Asked of t itself, not of its key: a ray that goes on where it hit, from tMin =
// hit.t, must not hit the same triangle again by the rounding from one to the other.
struct KeyRange {
    float dz, tMin, tMax;
    float farthest() const { return depthCut(1.0f / (tMax * dz)); } // no box behind it counts
    bool contains(float key) const {
        if (!(key > 0)) return false;
        const float t = 1.0f / (key * dz);
        return t > tMin && t < tMax;
    }
};

// Weights of the corners 1 and 2, from edge functions without error.
Vec2 barycentrics(const RaySetup& setup, Vec3 v0, Vec3 v1, Vec3 v2) {
    const Vec3d e = ShearedTriangle(setup, v0, v1, v2).edgesExact();
    const double sum = e.x + e.y + e.z;
    return {static_cast<float>(e.y / sum), static_cast<float>(e.z / sum)};
}

} // namespace

std::uint64_t MeshGeometry::dropDegenerate() {
    std::uint64_t withoutArea = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Corners c = triangles[i];
        const Vec3 v0 = points[c[0]], v1 = points[c[1]], v2 = points[c[2]];
        if (crossOfEdges(v0, v1, v2) == Vec3d{}) ++withoutArea;
        if (v0 == v1 || v1 == v2 || v2 == v0) continue;
        triangles[kept] = c;
        if (!normalTriangles.empty()) normalTriangles[kept] = normalTriangles[i];
        if (!uvTriangles.empty()) uvTriangles[kept] = uvTriangles[i];
        if (!slots.empty()) slots[kept] = slots[i];
        ++kept;
    }
    triangles.resize(kept);
    if (!normalTriangles.empty()) normalTriangles.resize(kept);
    if (!uvTriangles.empty()) uvTriangles.resize(kept);
    if (!slots.empty()) slots.resize(kept);
    return withoutArea;
}

void MeshGeometry::collapseEndless() {
    const auto isNowhere = [](Vec3 p) { return p * 0.0f != Vec3{}; };
    if (std::none_of(points.begin(), points.end(), isNowhere)) return;
    for (Corners& c : triangles) {
        const auto nowhere = [&](std::uint32_t corner) { return isNowhere(points[corner]); };
        const auto* const bad = std::find_if(c.begin(), c.end(), nowhere);
        if (bad != c.end()) c = {*bad, *bad, *bad};
    }
    std::replace_if(points.begin(), points.end(), isNowhere, Vec3{});
}

void MeshGeometry::finish(bool withTree, const Kernel& forKernel, int threads) {
    collapseEndless();
    extent = 0;
    for (const Vec3 p : points) extent = max(maxAbs(p), extent);
    if (!withTree || triangles.empty()) return;
    if (forKernel.width > 0) {
        kernel = &forKernel;
        wide = buildWide(forKernel.width, points, triangles, threads);
        return;
    }
    {
        std::vector<Bounds> boxes(triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i)
            for (const std::uint32_t corner : triangles[i]) boxes[i].extend(points[corner]);
        bvh = buildBvh(boxes, threads, std::numeric_limits<std::uint32_t>::max());
    }
    bvh.nodes.shrink_to_fit();
}

std::size_t MeshGeometry::bytes() const {
    return bvh.bytes() + wide.bytes() + points.size() * sizeof(Vec3) +
           triangles.size() * sizeof(Corners) + normals.size() * sizeof(Vec3) +
           normalTriangles.size() * sizeof(Corners) + uvs.size() * sizeof(Vec2) +
           uvTriangles.size() * sizeof(Corners) + slots.size() * 4;
}

Mesh::Mesh(const MeshGeometry& geometry, MovingTransform worldFromObject,
           std::vector<std::uint32_t> materials, std::vector<MeshPart> parts,
           const Transform& objectFromMesh)
    : geometry_(geometry), worldFromObject_(std::move(worldFromObject)),
      objectFromMesh_(objectFromMesh), worldFromMesh_(worldFromObject_.at(0) * objectFromMesh),
      meshFromWorld_(worldFromMesh_.inverse()),
      identity_(worldFromObject_.isStatic() && worldFromMesh_.isIdentity()),
      materials_(std::move(materials)), parts_(std::move(parts)) {
    Bounds box;
    for (const auto& corners : geometry.triangles)
        for (const std::uint32_t corner : corners) box.extend(geometry.points[corner]);
    if (box.isEmpty()) return;
    if (identity_)
        bounds_ = box;
    else if (worldFromObject_.isStatic())
        bounds_ = outward(worldFromMesh_.bounds(toDouble(box)));
    else
        bounds_ = outward(worldFromObject_.bounds(objectFromMesh_.bounds(toDouble(box))));
}

Bounds Mesh::bounds() const { return bounds_; }

Transform Mesh::worldFromMeshAt(float time) const {
    if (worldFromObject_.isStatic()) return worldFromMesh_;
    return worldFromObject_.at(static_cast<double>(time)) * objectFromMesh_;
}

Ray Mesh::meshRay(const Ray& worldRay) const {
    if (identity_) return worldRay;
    if (worldFromObject_.isStatic()) return meshFromWorld_.ray(worldRay);
    return worldFromMeshAt(worldRay.time).inverse().ray(worldRay);
}

float Mesh::keyOf(const RaySetup& setup, std::uint32_t triangle) const {
    const auto& c = geometry_.triangles[triangle];
    return canonicalKey(setup, geometry_.points[c[0]], geometry_.points[c[1]],
                        geometry_.points[c[2]]);
}

template <class LeafFn>
void Mesh::forEachTriangle(const RaySetup& setup, float zCut, LeafFn&& leaf) const {
    if (!geometry_.bvh.nodes.empty()) return traverse(geometry_.bvh, setup, zCut, leaf);
    if (!geometry_.wide.isEmpty()) return traverse(geometry_.wide, setup, zCut, leaf);
    for (std::uint32_t i = 0; i < geometry_.triangles.size(); ++i)
        if (leaf(i, zCut)) return;
}

bool Mesh::intersect(const Ray& worldRay, Hit& hit) const {
    const Ray ray = meshRay(worldRay);
    if (!isTraceable(ray)) return false;
    const RaySetup setup(ray.org, ray.dir, geometry_.extent);
    const KeyRange range{setup.dz, ray.tMin, kInfinityF};

    float bestKey = 0;
    std::uint32_t best = 0;
    const float zLimit = depthCut(1.0f / (hit.t * setup.dz)); // behind it nothing is wanted
    forEachTriangle(setup, zLimit, [&](std::uint32_t triangle, float& zCut) {
        const float key = keyOf(setup, triangle);
        if (!range.contains(key)) return false;
        if (key > bestKey || (key == bestKey && triangle < best)) {
            bestKey = key;
            best = triangle;
            zCut = min(depthCut(key), zCut);
        }
        return false;
    });
    const float t = 1.0f / (bestKey * setup.dz);
    if (bestKey == 0 || !(t <= hit.t)) return false;
    const auto& c = geometry_.triangles[best];
    const Vec2 uv =
        barycentrics(setup, geometry_.points[c[0]], geometry_.points[c[1]], geometry_.points[c[2]]);
    hit.t = t;
    hit.u = uv.x;
    hit.v = uv.y;
    hit.prim = best;
    return true;
}

bool Mesh::occludes(const Ray& worldRay) const {
    const Ray ray = meshRay(worldRay);
    if (!isTraceable(ray)) return false;
    const RaySetup setup(ray.org, ray.dir, geometry_.extent);
    const KeyRange range{setup.dz, ray.tMin, ray.tMax};
    bool found = false;
    forEachTriangle(setup, range.farthest(), [&](std::uint32_t triangle, float&) {
        found = range.contains(keyOf(setup, triangle));
        return found;
    });
    return found;
}

void Mesh::intersectBatch(const RaySpan& rays, std::uint32_t number, std::span<Hit> hits) const {
    if (!takesBatches()) return Shape::intersectBatch(rays, number, hits);
    thread_local std::vector<TriangleHit> found;
    found.resize(rays.size());
    closestHits(*geometry_.kernel, geometry_.wideMesh(), rays, found);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits[i] = {.t = rays.tMax[i]};
        if (found[i].triangle == TriangleHit::kNone) continue;
        const auto& c = geometry_.triangles[found[i].triangle];
        const Vec2 uv =
            barycentrics(RaySetup(rays.org[i], rays.dir[i], geometry_.extent),
                         geometry_.points[c[0]], geometry_.points[c[1]], geometry_.points[c[2]]);
        hits[i] = {
            .t = found[i].t, .u = uv.x, .v = uv.y, .prim = found[i].triangle, .shape = number};
    }
}

void Mesh::occludesBatch(const RaySpan& rays, std::span<std::uint8_t> hidden) const {
    if (!takesBatches()) return Shape::occludesBatch(rays, hidden);
    anyHits(*geometry_.kernel, geometry_.wideMesh(), rays, hidden);
}

void Mesh::collect(const Ray& worldRay, std::vector<Hit>& hits) const {
    const Ray ray = meshRay(worldRay);
    if (!isTraceable(ray)) return;
    const RaySetup setup(ray.org, ray.dir, geometry_.extent);
    const KeyRange range{setup.dz, ray.tMin, ray.tMax};
    forEachTriangle(setup, range.farthest(), [&](std::uint32_t triangle, float&) {
        const float key = keyOf(setup, triangle);
        if (!range.contains(key)) return false;
        const auto& c = geometry_.triangles[triangle];
        const Vec3 v0 = geometry_.points[c[0]], v1 = geometry_.points[c[1]];
        const Vec3 v2 = geometry_.points[c[2]];
        // What crosses a surface on an edge crosses it once.
        if (!ShearedTriangle(setup, v0, v1, v2).ownsRay()) return false;
        const Vec2 uv = barycentrics(setup, v0, v1, v2);
        hits.push_back({.t = 1.0f / (key * setup.dz), .u = uv.x, .v = uv.y, .prim = triangle});
        return false;
    });
}
