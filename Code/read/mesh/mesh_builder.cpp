#include "read/mesh/mesh_builder.h"

#include "base/for_each.h"
#include "read/mesh/exact_orientation.h"
#include "read/mesh/mesh_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

using Corners = MeshDesc::Corners;
constexpr Corners kAllMissing{MeshBuilder::kMissing, MeshBuilder::kMissing, MeshBuilder::kMissing};

// All three corners are, or none.
bool isMissing(const Corners& c) { return c[0] == MeshBuilder::kMissing; }

// Exactly: seen along all three axes, the corners are on one line. Corners that are NaN have none.
bool hasArea(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    if (surelyTurn({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) ||
        surelyTurn({a.y, a.z}, {b.y, b.z}, {c.y, c.z}))
        return true;
    if (std::isnan(a.x + b.x + c.x)) return false;
    return orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) != 0 ||
           orientation({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) != 0 ||
           orientation({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) != 0;
}

// Arrays that few files need begin with the first triangle that needs them; those before get what
// is missing.
template <class T>
void append(RawVector<T>& array, bool isNeeded, std::size_t before, std::size_t expected,
            const T& missing, const T& value) {
    if (array.empty()) {
        if (!isNeeded) return;
        array.reserve(std::max(expected, before + 1));
        array.resize(before, missing);
    }
    array.push_back(value);
}

// Appends the arrays of parts, of which part i begins at triangle starts[i]; the last start is the
// end of all. arrayOf(part) may have less than all of its triangles, or none.
template <class T, class ArrayOf>
void appendAll(RawVector<T>& array, std::span<const MeshBuilder> parts,
               std::span<const std::size_t> starts, int threads, const T& missing,
               const ArrayOf& arrayOf) {
    if (array.empty() && std::all_of(parts.begin(), parts.end(), [&](const MeshBuilder& part) {
            return arrayOf(part).empty();
        }))
        return;
    array.resize(starts.front(), missing);
    array.resize(starts.back());
    forEachOn(threads, parts.size(), [&](std::size_t i) {
        const RawVector<T>& more = arrayOf(parts[i]);
        T* const first = array.data() + starts[i];
        std::fill(std::copy(more.begin(), more.end(), first), array.data() + starts[i + 1],
                  missing);
    });
}

} // namespace

void MeshBuilder::reserve(std::size_t triangles) {
    expected_ = triangles;
    mesh.triangles.reserve(triangles);
}

bool MeshBuilder::addTriangle(const Corner& a, const Corner& b, const Corner& c) {
    if (a.point == b.point || b.point == c.point || c.point == a.point ||
        !hasArea(points()[a.point], points()[b.point], points()[c.point]))
        return false;
    const std::size_t before = mesh.triangles.size();
    mesh.triangles.push_back({a.point, b.point, c.point});
    append(mesh.uvTriangles, a.uv != kMissing, before, expected_, kAllMissing, {a.uv, b.uv, c.uv});
    append(mesh.normalTriangles, a.normal != kMissing, before, expected_, kAllMissing,
           {a.normal, b.normal, c.normal});
    append(mesh.triangleMaterials, slot != 0, before, expected_, 0u, slot);
    append(groups_, group != 0, before, expected_, 0u, group);
    return true;
}

bool MeshBuilder::addFace(std::span<const Corner> corners) {
    if (corners.size() == 3) return addTriangle(corners[0], corners[1], corners[2]);
    polygon_.clear();
    for (const Corner& c : corners) polygon_.push_back(points()[c.point]);
    if (std::any_of(polygon_.begin(), polygon_.end(), [](Vec3d p) { return std::isnan(p.x); }))
        return false;
    pieces_.clear();
    triangulate(polygon_, pieces_);
    bool any = false;
    for (const Corners& t : pieces_)
        any = addTriangle(corners[t[0]], corners[t[1]], corners[t[2]]) || any;
    return any;
}

MeshBuilder MeshBuilder::part(std::size_t triangles) const {
    MeshBuilder some;
    some.slot = slot;
    some.group = group;
    some.points_ = &mesh.points;
    some.reserve(triangles);
    if (!mesh.uvs.empty()) some.mesh.uvTriangles.reserve(triangles);
    if (!mesh.normals.empty()) some.mesh.normalTriangles.reserve(triangles);
    if (slot != 0) some.mesh.triangleMaterials.reserve(triangles);
    if (group != 0) some.groups_.reserve(triangles);
    return some;
}

void MeshBuilder::addFaces(std::span<const MeshBuilder> parts, int threads) {
    std::vector<std::size_t> starts{mesh.triangles.size()};
    for (const MeshBuilder& part : parts)
        starts.push_back(starts.back() + part.mesh.triangles.size());
    const auto add = [&](auto& array, const auto& missing, const auto& arrayOf) {
        appendAll(array, parts, starts, threads, missing, arrayOf);
    };
    const auto addOfMesh = [&](auto array, const auto& missing) { // of a MeshDesc
        add(
            mesh.*array,
            missing, [&](const MeshBuilder& part) -> const auto& { return part.mesh.*array; });
    };
    addOfMesh(&MeshDesc::triangles, kAllMissing);
    addOfMesh(&MeshDesc::uvTriangles, kAllMissing);
    addOfMesh(&MeshDesc::normalTriangles, kAllMissing);
    addOfMesh(&MeshDesc::triangleMaterials, 0u);
    add(
        groups_, 0u, [](const MeshBuilder& part) -> const auto& { return part.groups_; });
}

void MeshBuilder::fillUvs(int threads) {
    if (mesh.uvTriangles.empty()) return mesh.uvs.clear();
    if (std::any_of(mesh.uvTriangles.begin(), mesh.uvTriangles.end(), isMissing)) {
        const auto zero = static_cast<std::uint32_t>(mesh.uvs.size());
        mesh.uvs.push_back({0, 0});
        for (Corners& c : mesh.uvTriangles)
            if (isMissing(c)) c = {zero, zero, zero};
    }
    dropUnused(mesh.uvTriangles, threads, mesh.uvs);
}

void MeshBuilder::fillNormals(int threads) {
    RawVector<Corners>& corners = mesh.normalTriangles;
    if (corners.empty()) {
        mesh.normals.clear();
        if (!groups_.empty()) smoothByGroup(mesh, groups_, threads);
        return;
    }
    if (std::any_of(corners.begin(), corners.end(), isMissing)) {
        RawVector<Vec3> given = std::move(mesh.normals);
        RawVector<Corners> givenCorners = std::exchange(corners, {});
        groups_.resize(mesh.triangles.size(), 0);
        smoothByGroup(mesh, groups_, threads);
        const auto offset = static_cast<std::uint32_t>(given.size());
        given.insert(given.end(), mesh.normals.begin(), mesh.normals.end());
        mesh.normals = std::move(given);
        for (std::size_t i = 0; i < corners.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                corners[i][k] =
                    isMissing(givenCorners[i]) ? offset + corners[i][k] : givenCorners[i][k];
    }
    dropUnused(corners, threads, mesh.normals);
}

MeshBuilder::Dropped MeshBuilder::finish(int threads) {
    Dropped dropped;
    dropped.points = dropUnused(mesh.triangles, threads, mesh.points);
    fillUvs(threads);
    fillNormals(threads);
    return dropped;
}
