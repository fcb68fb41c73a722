#include "render/merge.h"

#include <algorithm>

namespace {

using Corners = MeshGeometry::Corners;

// Appends corner indices, raised by `base`; `flip` swaps two corners to turn the triangle over.
void append(std::vector<Corners>& to, const std::vector<Corners>& from, std::size_t base,
            bool flip = false) {
    const auto b = static_cast<std::uint32_t>(base);
    if (to.empty()) to.reserve(from.size()); // and not each time: many small parts
    for (const Corners& c : from) {
        if (c == MeshGeometry::kWithout)
            to.push_back(c);
        else
            to.push_back(flip ? Corners{c[0] + b, c[2] + b, c[1] + b}
                              : Corners{c[0] + b, c[1] + b, c[2] + b});
    }
}

// Appends the corners in normals or coordinates of a part. Where one of the two has none but the
// other does, its triangles are marked: they look as they do alone.
void appendOptional(std::vector<Corners>& to, std::size_t before, const std::vector<Corners>& from,
                    std::size_t count, std::size_t base) {
    if (to.empty() && from.empty()) return;
    to.resize(before, MeshGeometry::kWithout);
    append(to, from, base);
    to.resize(before + count, MeshGeometry::kWithout);
}

// The mesh placed by a transform, slots raised by `slotBase`.
MeshGeometry placedGeometry(const MeshDesc& mesh, const Transform& sceneFromMesh,
                            std::uint32_t slotBase) {
    MeshGeometry out;
    const bool flip = sceneFromMesh.mirrors();
    out.points.reserve(mesh.points.size());
    for (const Vec3d p : mesh.points) out.points.push_back(placedPoint(sceneFromMesh, p));
    append(out.triangles, mesh.triangles, 0, flip);
    for (const Vec3 n : mesh.normals) out.normals.push_back(placedNormal(sceneFromMesh, n));
    append(out.normalTriangles, mesh.normalTriangles, 0, flip);
    out.uvs = mesh.uvs;
    append(out.uvTriangles, mesh.uvTriangles, 0, flip);
    out.slots.assign(mesh.triangles.size(), slotBase);
    for (std::size_t i = 0; i < mesh.triangleMaterials.size(); ++i)
        out.slots[i] += mesh.triangleMaterials[i];
    return out;
}

} // namespace

MeshGeometry toGeometry(const MeshDesc& mesh, const SceneFrame& frame) {
    return placedGeometry(mesh, frame.placed(Transform().rows()), 0);
}

MeshGeometry toSharedGeometry(const MeshDesc& mesh) {
    const SceneFrame own = frameOf(mesh);
    const Transform treeFromObject = own.placed(Transform().rows());
    MeshGeometry out = placedGeometry(mesh, treeFromObject, 0);
    out.treeFromObject = treeFromObject;
    out.exactPoints = mesh.points;
    out.normals = mesh.normals;
    return out;
}

void MergedMesh::add(const MeshDesc& mesh, const Transform& sceneFromMesh,
                     const std::vector<std::uint32_t>& meshMaterials, std::uint32_t object) {
    MeshGeometry part =
        placedGeometry(mesh, sceneFromMesh, static_cast<std::uint32_t>(materials.size()));
    degenerateCount += part.dropDegenerate();
    if (part.triangles.empty()) return;
    parts.push_back({static_cast<std::uint32_t>(geometry.triangles.size()), object});
    materials.insert(materials.end(), meshMaterials.begin(), meshMaterials.end());
    if (geometry.triangles.empty()) {
        geometry = std::move(part);
        return;
    }
    const std::size_t before = geometry.triangles.size(), count = part.triangles.size();
    append(geometry.triangles, part.triangles, geometry.points.size());
    appendOptional(geometry.normalTriangles, before, part.normalTriangles, count,
                   geometry.normals.size());
    appendOptional(geometry.uvTriangles, before, part.uvTriangles, count, geometry.uvs.size());
    geometry.points.insert(geometry.points.end(), part.points.begin(), part.points.end());
    geometry.normals.insert(geometry.normals.end(), part.normals.begin(), part.normals.end());
    geometry.uvs.insert(geometry.uvs.end(), part.uvs.begin(), part.uvs.end());
    geometry.slots.insert(geometry.slots.end(), part.slots.begin(), part.slots.end());
}
