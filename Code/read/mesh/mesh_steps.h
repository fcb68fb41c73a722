// The triangles of a mesh as those who smooth it look at them: normals, angles, and which corners
// meet in a point.
#pragma once

#include "base/for_each.h"
#include "base/vec.h"
#include "desc/scene_desc.h"
#include "read/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

struct TriangleShape {
    Vec3d normal; // unit; zero for a triangle without area, so that it has no weight
    std::array<double, 3> angle{};
};
std::vector<TriangleShape> triangleShapes(const MeshDesc& mesh, int threads);

// The corners of all triangles in the order of their points, by counting: those of point i are
// [starts[i], starts[i + 1]) of `corners`, numbered 3 * triangle + corner.
struct CornersByPoint {
    std::vector<std::uint32_t> starts, corners;

    explicit CornersByPoint(const MeshDesc& mesh);
};

// Leaves out the values that no corner uses, in all of these arrays that have some, whose value i
// has the number i in the corners; returns how many of the first.
template <class T, class... More>
std::size_t dropUnused(RawVector<MeshDesc::Corners>& corners, int threads, RawVector<T>& values,
                       RawVector<More>&... more) {
    constexpr std::size_t kTogether = 1 << 15;
    std::vector<std::uint8_t> used(values.size());
    forEachPart(threads, corners.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (const std::uint32_t value : corners[i])
                std::atomic_ref(used[value]).store(1, std::memory_order_relaxed);
    });
    const auto dropped = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
    if (dropped == 0) return 0;
    std::vector<std::uint32_t> newIndex(used.size());
    std::exclusive_scan(used.begin(), used.end(), newIndex.begin(), std::uint32_t{0});
    forEachPart(threads, corners.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::uint32_t& value : corners[i]) value = newIndex[value];
    });
    const auto keepUsed = [&](auto& array) {
        if (array.empty()) return;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i] != 0) array[newIndex[i]] = array[i];
        array.resize(used.size() - dropped);
    };
    keepUsed(values);
    (keepUsed(more), ...);
    return dropped;
}

// Triangles of a polygon, convex or not.

// Appends corners.size() - 2 triangles (none below three corners) of positions in `corners`, turned
// the same way round as the polygon. Ear clipping in the plane of Newell's normal, with signs of
// areas that are exact. Corners may be concave, collinear or repeated; a polygon that crosses
// itself gives some triangles, always as many and always in finite time. Convex polygons become the
// fan of their first corner. Triangles without area arise only where there is no other way.
void triangulate(std::span<const Vec3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

// Time grows with the square of the corners of a bad polygon (half a second for this many): readers
// refuse more than this.
inline constexpr std::size_t kMostCorners = 32768;

// Normals for meshes that come without.

// Replaces the normals of the mesh: at each corner the mean of the normals of the triangles around
// the point, weighted with their angle there (Thürmer and Wüthrich 1998), over those triangles that
// bend less than smoothAngleDeg away from the corner's own. 180: all of them; 0: no normals, flat.
// Around points with more than 512 triangles directions are compared in steps of ten degrees. The
// normals do not depend on the number of threads (0: as many as the machine has).
void smoothByAngle(MeshDesc& mesh, double smoothAngleDeg, int threads = 1);

// The same over the triangles of equal group; group 0 stays flat. groups: one per triangle.
void smoothByGroup(MeshDesc& mesh, std::span<const std::uint32_t> groups, int threads = 1);

// The parts of a mesh file as meshes of their own.

struct SeparatePart {
    MeshDesc mesh; // named as its part; triangleMaterials count in `slots`
    std::vector<std::uint32_t>
        slots; // which of MeshFile::materials it uses, none when there are none
};
// In the order of the file. One part takes the arrays as they are; several take only what they use.
std::vector<SeparatePart> splitMesh(MeshFile file);
