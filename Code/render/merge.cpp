#include "render/merge.h"

#include <algorithm>

namespace {

using Corners = MeshGeometry::Corners;

Vec3 unit(Vec3d n) {
    const double length2 = dot(n, n);
    return length2 > 0 ? toFloat(n / std::sqrt(length2)) : Vec3{};
}

// Appends corner indices, raised by `base`; `flip` swaps two corners to turn the triangle over.
void append(std::vector<Corners>& to, const std::vector<Corners>& from, std::size_t base,
            bool flip) {
    const auto b = static_cast<std::uint32_t>(base);
    to.reserve(to.size() + from.size());
    for (const Corners& c : from)
        to.push_back(flip ? Corners{c[0] + b, c[2] + b, c[1] + b}
                          : Corners{c[0] + b, c[1] + b, c[2] + b});
}

// The mesh placed by a transform and normalised, slots raised by `slotBase`.
MeshGeometry placedGeometry(const MeshDesc& mesh, const Transform& worldFromMesh,
                            const SceneFrame& frame, std::uint32_t slotBase) {
    MeshGeometry out;
    const bool flip = worldFromMesh.mirrors();
    out.points.reserve(mesh.points.size());
    for (const Vec3d p : mesh.points)
        out.points.push_back(toFloat(frame.point(worldFromMesh.point(p))));
    append(out.triangles, mesh.triangles, 0, flip);
    for (const Vec3 n : mesh.normals)
        out.normals.push_back(unit(worldFromMesh.normal(toDouble(n))));
    append(out.normalTriangles, mesh.normalTriangles, 0, flip);
    out.uvs = mesh.uvs;
    append(out.uvTriangles, mesh.uvTriangles, 0, flip);
    out.slots.assign(mesh.triangles.size(), slotBase);
    for (std::size_t i = 0; i < mesh.triangleMaterials.size(); ++i)
        out.slots[i] += mesh.triangleMaterials[i];
    return out;
}

// Gives a geometry without normals or uvs those that mean the same: flat normals, no coordinates.
void completeNormals(MeshGeometry& g) {
    if (!g.normalTriangles.empty()) return;
    for (const Corners& c : g.triangles) {
        const Vec3d v0 = toDouble(g.points[c[0]]);
        const auto n = static_cast<std::uint32_t>(g.normals.size());
        g.normals.push_back(
            unit(cross(toDouble(g.points[c[1]]) - v0, toDouble(g.points[c[2]]) - v0)));
        g.normalTriangles.push_back({n, n, n});
    }
}

void completeUvs(MeshGeometry& g) {
    if (!g.uvTriangles.empty()) return;
    const auto zero = static_cast<std::uint32_t>(g.uvs.size());
    g.uvs.push_back({});
    g.uvTriangles.assign(g.triangles.size(), {zero, zero, zero});
}

} // namespace

MeshGeometry toGeometry(const MeshDesc& mesh, const SceneFrame& frame) {
    return placedGeometry(mesh, Transform(), frame, 0);
}

void MergedMesh::add(const MeshDesc& mesh, const Transform& worldFromMesh, const SceneFrame& frame,
                     const std::vector<std::uint32_t>& meshMaterials, std::uint32_t object) {
    MeshGeometry part =
        placedGeometry(mesh, worldFromMesh, frame, static_cast<std::uint32_t>(materials.size()));
    degenerateCount += part.dropDegenerate();
    if (part.triangles.empty()) return;
    parts.push_back({static_cast<std::uint32_t>(geometry.triangles.size()), object});
    materials.insert(materials.end(), meshMaterials.begin(), meshMaterials.end());
    if (geometry.triangles.empty()) {
        geometry = std::move(part);
        return;
    }
    if (geometry.normalTriangles.empty() != part.normalTriangles.empty()) {
        completeNormals(geometry);
        completeNormals(part);
    }
    if (geometry.uvTriangles.empty() != part.uvTriangles.empty()) {
        completeUvs(geometry);
        completeUvs(part);
    }
    append(geometry.triangles, part.triangles, geometry.points.size(), false);
    append(geometry.normalTriangles, part.normalTriangles, geometry.normals.size(), false);
    append(geometry.uvTriangles, part.uvTriangles, geometry.uvs.size(), false);
    geometry.points.insert(geometry.points.end(), part.points.begin(), part.points.end());
    geometry.normals.insert(geometry.normals.end(), part.normals.begin(), part.normals.end());
    geometry.uvs.insert(geometry.uvs.end(), part.uvs.begin(), part.uvs.end());
    geometry.slots.insert(geometry.slots.end(), part.slots.begin(), part.slots.end());
}
