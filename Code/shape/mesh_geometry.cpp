#include "shape/mesh_geometry.h"

#include "accel/kernels/placed.h"
#include "base/for_each.h"
#include "shape/share_points.h"

#include <algorithm>
#include <limits>

namespace {

constexpr std::size_t kTogether = 1 << 13; // triangles and points that one thread looks at

float longestSideOf(const MeshGeometry& mesh, std::uint32_t triangle) {
    const auto& c = mesh.triangles[triangle];
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        longest = max(length(mesh.exactPoints[c[i]] - mesh.exactPoints[c[(i + 1) % 3]]), longest);
    return floatAbove(longest);
}

// What a wide tree does not say of the exact triangles of its nodes and leaves, from `ref` down.
template <int W> float describeExact(MeshGeometry& mesh, WideRef ref) {
    static_assert(sizeof(WideLeaf<W>) / sizeof(WideTree::Line) * TreeVisit::kPerLine == W);
    float longest = 0;
    if (kindOf(ref) == WideKind::None) return longest;
    const std::size_t line = ref >> 2;
    if (kindOf(ref) == WideKind::Leaf) {
        const auto& leaf = mesh.wide.at<WideLeaf<W>>(ref);
        Vec3d* const points = &mesh.leafPoints[line * TreeVisit::kPerLine];
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const std::uint32_t triangle = mesh.wide.triangleIds[leaf.first + i];
            longest = max(longestSideOf(mesh, triangle), longest);
            for (std::size_t corner = 0; corner < 3; ++corner)
                points[leaf.corner[corner][i]] = mesh.exactPoints[mesh.triangles[triangle][corner]];
        }
    } else {
        for (const WideRef child : mesh.wide.at<WideNode<W>>(ref).child)
            longest = max(describeExact<W>(mesh, child), longest);
    }
    return mesh.longestSide[line] = longest;
}

void describeExact(MeshGeometry& mesh) {
    mesh.longestSide.assign(mesh.wide.lines.size(), 0);
    mesh.leafPoints.resize(mesh.wide.lines.size() * TreeVisit::kPerLine);
    if (mesh.wide.width == 16)
        describeExact<16>(mesh, mesh.wide.root);
    else
        describeExact<8>(mesh, mesh.wide.root);
}

// Takes the entries of these numbers, which ascend, out of a list that may be empty: what is
// between two of them moves at once.
template <class T> void removeAt(const std::vector<std::size_t>& dropped, RawVector<T>& list) {
    if (list.empty()) return;
    auto kept = list.begin() + static_cast<std::ptrdiff_t>(dropped[0]);
    for (std::size_t i = 0; i < dropped.size(); ++i) {
        const std::size_t end = i + 1 < dropped.size() ? dropped[i + 1] : list.size();
        kept = std::move(list.begin() + static_cast<std::ptrdiff_t>(dropped[i]) + 1,
                         list.begin() + static_cast<std::ptrdiff_t>(end), kept);
    }
    list.erase(kept, list.end());
}

} // namespace

std::uint64_t MeshGeometry::dropDegenerate(int threads) {
    const auto coincide = [this](std::uint32_t a, std::uint32_t b) {
        return exactPoints.empty() ? points[a] == points[b] : exactPoints[a] == exactPoints[b];
    };
    struct Found {
        std::uint64_t withoutArea = 0;
        std::vector<std::size_t> dropped;
    };
    std::vector<Found> parts((triangles.size() + kTogether - 1) / kTogether);
    forEachPart(threads, triangles.size(), kTogether, [&](std::size_t first, std::size_t last) {
        Found part; // far from those of other threads
        for (std::size_t i = first; i < last; ++i) {
            const Corners& c = triangles[i];
            const Vec3d v0 = toDouble(points[c[0]]);
            if (cross(toDouble(points[c[1]]) - v0, toDouble(points[c[2]]) - v0) == Vec3d{})
                ++part.withoutArea;
            if (coincide(c[0], c[1]) || coincide(c[1], c[2]) || coincide(c[2], c[0]))
                part.dropped.push_back(i);
        }
        parts[first / kTogether] = std::move(part);
    });
    std::uint64_t withoutArea = 0;
    std::vector<std::size_t> dropped;
    for (const Found& part : parts) {
        withoutArea += part.withoutArea;
        dropped.insert(dropped.end(), part.dropped.begin(), part.dropped.end());
    }
    if (dropped.empty()) return withoutArea;
    removeAt(dropped, triangles), removeAt(dropped, slots);
    removeAt(dropped, normalTriangles), removeAt(dropped, uvTriangles);
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
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!isNowhere(points[i])) continue;
        points[i] = {};
        if (!exactPoints.empty()) exactPoints[i] = {};
    }
}

void MeshGeometry::measure(int threads) {
    struct Measured {
        float extent = kSceneExtent;
        BoundsD exactBox;
        Bounds box;
    };
    const std::size_t most = std::max(points.size(), triangles.size());
    std::vector<Measured> parts((most + kTogether - 1) / kTogether);
    forEachPart(threads, most, kTogether, [&](std::size_t first, std::size_t last) {
        Measured part; // far from those of other threads
        for (std::size_t i = first; i < std::min(last, points.size()); ++i)
            part.extent = max(maxAbs(points[i]), part.extent);
        for (std::size_t i = first; i < std::min(last, exactPoints.size()); ++i)
            part.exactBox.extend(exactPoints[i]);
        for (std::size_t i = first; i < std::min(last, triangles.size()); ++i)
            for (const std::uint32_t corner : triangles[i]) part.box.extend(points[corner]);
        parts[first / kTogether] = part;
    });
    Measured all;
    for (const Measured& part : parts) {
        all.extent = max(part.extent, all.extent);
        all.exactBox.extend(part.exactBox);
        all.box.extend(part.box);
    }
    extent = all.extent, exactBox = all.exactBox, box = all.box;
}

void MeshGeometry::finish(bool withTree, const Isa& forIsa, int threads) {
    collapseEndless();
    if (withTree) sharePoints(*this, threads);
    measure(threads);
    if (!withTree || triangles.empty()) return;
    if (forIsa.triangles != nullptr) isa = &forIsa;
    wide = buildWide(forIsa.nodeWidth(), points, triangles, threads);
    if (!exactPoints.empty()) describeExact(*this);
}

std::size_t MeshGeometry::bytes() const {
    return wide.bytes() + longestSide.size() * sizeof(float) + leafPoints.size() * sizeof(Vec3d) +
           points.size() * sizeof(Vec3) + exactPoints.size() * sizeof(Vec3d) +
           triangles.size() * sizeof(Corners) + normals.size() * sizeof(Vec3) +
           normalTriangles.size() * sizeof(Corners) + uvs.size() * sizeof(Vec2) +
           uvTriangles.size() * sizeof(Corners) + slots.size() * 4;
}
