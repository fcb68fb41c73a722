#include "scene/merge.h"

#include "base/for_each.h"

namespace {

using Corners = MeshGeometry::Corners;

constexpr std::size_t kTogether = 1 << 13; // for one thread

// Appends corner indices, raised by `base`; `flip` swaps two corners to turn the triangle over.
void append(RawVector<Corners>& to, const RawVector<Corners>& from, std::size_t base, int threads,
            bool flip = false) {
    const auto b = static_cast<std::uint32_t>(base);
    const std::size_t before = to.size();
    to.resize(before + from.size());
    forEachPart(threads, from.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Corners& c = from[i];
            to[before + i] = c[0] == MeshGeometry::kWithout[0] ? c
                             : flip ? Corners{c[0] + b, c[2] + b, c[1] + b}
                                    : Corners{c[0] + b, c[1] + b, c[2] + b};
        }
    });
}

// Appends the corners in normals or coordinates of a part. Where one of the two has none but the
// other does, its triangles are marked: they look as they do alone.
void appendOptional(RawVector<Corners>& to, std::size_t before, const RawVector<Corners>& from,
                    std::size_t count, std::size_t base, int threads) {
    if (to.empty() && from.empty()) return;
    to.resize(before, MeshGeometry::kWithout);
    append(to, from, base, threads);
    to.resize(before + count, MeshGeometry::kWithout);
}

// The mesh placed by a transform, slots raised by `slotBase`.
MeshGeometry placedGeometry(const MeshDesc& mesh, const Transform& sceneFromMesh,
                            std::uint32_t slotBase, int threads) {
    MeshGeometry out;
    const bool flip = sceneFromMesh.mirrors();
    out.points.resize(mesh.points.size());
    forEachPart(threads, mesh.points.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            out.points[i] = placedPoint(sceneFromMesh, mesh.points[i]);
    });
    append(out.triangles, mesh.triangles, 0, threads, flip);
    out.normals.resize(mesh.normals.size());
    forEachPart(threads, mesh.normals.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            out.normals[i] = placedNormal(sceneFromMesh, mesh.normals[i]);
    });
    append(out.normalTriangles, mesh.normalTriangles, 0, threads, flip);
    out.uvs = mesh.uvs;
    append(out.uvTriangles, mesh.uvTriangles, 0, threads, flip);
    if (slotBase == 0 && mesh.triangleMaterials.empty()) return out;
    out.slots.assign(mesh.triangles.size(), slotBase);
    for (std::size_t i = 0; i < mesh.triangleMaterials.size(); ++i)
        out.slots[i] += mesh.triangleMaterials[i];
    return out;
}

} // namespace

MeshGeometry toGeometry(const MeshDesc& mesh, const SceneFrame& frame) {
    return placedGeometry(mesh, frame.placed(Transform().rows()), 0, 1);
}

MeshGeometry toSharedGeometry(const MeshDesc& mesh, int threads) {
    const SceneFrame own = frameOf(mesh);
    const Transform treeFromObject = own.placed(Transform().rows());
    MeshGeometry out = placedGeometry(mesh, treeFromObject, 0, threads);
    out.treeFromObject = treeFromObject;
    out.exactPoints = mesh.points;
    out.normals = mesh.normals;
    return out;
}

void MergedMesh::add(const MeshDesc& mesh, const Transform& sceneFromMesh,
                     const std::vector<std::uint32_t>& meshMaterials, std::uint32_t object,
                     int threads) {
    MeshGeometry part =
        placedGeometry(mesh, sceneFromMesh, static_cast<std::uint32_t>(materials.size()), threads);
    degenerateCount += part.dropDegenerate(threads);
    if (part.triangles.empty()) return;
    parts.push_back({static_cast<std::uint32_t>(geometry.triangles.size()), object});
    materials.insert(materials.end(), meshMaterials.begin(), meshMaterials.end());
    if (geometry.triangles.empty()) {
        geometry = std::move(part);
        return;
    }
    const std::size_t before = geometry.triangles.size(), count = part.triangles.size();
    append(geometry.triangles, part.triangles, geometry.points.size(), threads);
    appendOptional(geometry.normalTriangles, before, part.normalTriangles, count,
                   geometry.normals.size(), threads);
    appendOptional(geometry.uvTriangles, before, part.uvTriangles, count, geometry.uvs.size(),
                   threads);
    geometry.points.insert(geometry.points.end(), part.points.begin(), part.points.end());
    geometry.normals.insert(geometry.normals.end(), part.normals.begin(), part.normals.end());
    geometry.uvs.insert(geometry.uvs.end(), part.uvs.begin(), part.uvs.end());
    if (geometry.slots.empty() && part.slots.empty()) return;
    geometry.slots.resize(before, 0);
    geometry.slots.insert(geometry.slots.end(), part.slots.begin(), part.slots.end());
    geometry.slots.resize(before + count, 0);
}
