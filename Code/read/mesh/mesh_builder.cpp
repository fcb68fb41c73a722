#include "read/mesh/mesh_builder.h"

#include "base/for_each.h"
#include "read/mesh/exact_orientation.h"
#include "read/mesh/smooth_normals.h"
#include "read/mesh/triangulate.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace {

using Corners = MeshDesc::Corners;
constexpr Corners kAllMissing{MeshBuilder::kMissing, MeshBuilder::kMissing, MeshBuilder::kMissing};

// All three corners are, or none.
bool isMissing(const Corners& c) { return c[0] == MeshBuilder::kMissing; }

// Exactly: seen along all three axes, the corners are on one line.
bool hasArea(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return surelyTurn({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) ||
           surelyTurn({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) ||
           orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) != 0 ||
           orientation({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) != 0 ||
           orientation({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) != 0;
}

// Arrays that few files need begin with the first triangle that needs them; those before get what
// is missing.
template <class T>
void append(std::vector<T>& array, bool isNeeded, std::size_t before, std::size_t expected,
            const T& missing, const T& value) {
    if (array.empty()) {
        if (!isNeeded) return;
        array.reserve(std::max(expected, before + 1));
        array.resize(before, missing);
    }
    array.push_back(value);
}

template <class T>
void appendAll(std::vector<T>& array, const std::vector<T>& more, std::size_t before,
               std::size_t count, std::size_t expected, const T& missing) {
    if (array.empty() && more.empty()) return;
    if (array.empty()) array.reserve(std::max(expected, before + count));
    array.resize(before, missing);
    array.insert(array.end(), more.begin(), more.end());
    array.resize(before + count, missing);
}

// Leaves out the values that no corner uses; returns how many.
template <class T>
std::size_t dropUnused(std::vector<T>& values, std::vector<Corners>& corners, int threads) {
    constexpr std::size_t kTogether = 1 << 15;
    std::vector<std::uint8_t> used(values.size());
    forEachPart(threads, corners.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (const std::uint32_t value : corners[i])
                std::atomic_ref(used[value]).store(1, std::memory_order_relaxed);
    });
    if (std::find(used.begin(), used.end(), 0) == used.end()) return 0;
    std::vector<std::uint32_t> newIndex(values.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (used[i] == 0) continue;
        newIndex[i] = count;
        values[count++] = values[i];
    }
    forEachPart(threads, corners.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::uint32_t& value : corners[i]) value = newIndex[value];
    });
    const std::size_t dropped = values.size() - count;
    values.resize(count);
    return dropped;
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

void MeshBuilder::addFaces(const MeshBuilder& part) {
    const std::size_t before = mesh.triangles.size(), count = part.mesh.triangles.size();
    const auto add = [&](auto& array, const auto& more, const auto& missing) {
        appendAll(array, more, before, count, expected_, missing);
    };
    mesh.triangles.insert(mesh.triangles.end(), part.mesh.triangles.begin(),
                          part.mesh.triangles.end());
    add(mesh.uvTriangles, part.mesh.uvTriangles, kAllMissing);
    add(mesh.normalTriangles, part.mesh.normalTriangles, kAllMissing);
    add(mesh.triangleMaterials, part.mesh.triangleMaterials, 0u);
    add(groups_, part.groups_, 0u);
}

void MeshBuilder::fillUvs(int threads) {
    if (mesh.uvTriangles.empty()) return mesh.uvs.clear();
    if (std::any_of(mesh.uvTriangles.begin(), mesh.uvTriangles.end(), isMissing)) {
        const auto zero = static_cast<std::uint32_t>(mesh.uvs.size());
        mesh.uvs.push_back({0, 0});
        for (Corners& c : mesh.uvTriangles)
            if (isMissing(c)) c = {zero, zero, zero};
    }
    dropUnused(mesh.uvs, mesh.uvTriangles, threads);
}

void MeshBuilder::fillNormals(int threads) {
    std::vector<Corners>& corners = mesh.normalTriangles;
    if (corners.empty()) {
        mesh.normals.clear();
        if (!groups_.empty()) smoothByGroup(mesh, groups_, threads);
        return;
    }
    if (std::any_of(corners.begin(), corners.end(), isMissing)) {
        std::vector<Vec3> given = std::move(mesh.normals);
        std::vector<Corners> givenCorners = std::exchange(corners, {});
        groups_.resize(mesh.triangles.size());
        smoothByGroup(mesh, groups_, threads);
        const auto offset = static_cast<std::uint32_t>(given.size());
        given.insert(given.end(), mesh.normals.begin(), mesh.normals.end());
        mesh.normals = std::move(given);
        for (std::size_t i = 0; i < corners.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                corners[i][k] =
                    isMissing(givenCorners[i]) ? offset + corners[i][k] : givenCorners[i][k];
    }
    dropUnused(mesh.normals, corners, threads);
}

MeshBuilder::Dropped MeshBuilder::finish(int threads) {
    Dropped dropped;
    dropped.points = dropUnused(mesh.points, mesh.triangles, threads);
    fillUvs(threads);
    fillNormals(threads);
    return dropped;
}
