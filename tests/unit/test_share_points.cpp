// sharePoints(): corners in one place become one point, and nothing else changes.
#include "shape/share_points.h"

#include "check.h"
#include "verify/meshes.h"

#include <array>
#include <bit>

namespace test_share_points {

namespace {

// Every triangle with corners of its own.
MeshDesc apart(const MeshDesc& mesh) {
    MeshDesc out;
    for (const MeshDesc::Corners& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(out.points.size());
        for (const std::uint32_t corner : t) out.points.push_back(mesh.points[corner]);
        out.triangles.push_back({first, first + 1, first + 2});
    }
    return out;
}

MeshGeometry placed(const MeshDesc& mesh) { return toGeometry(mesh, frameOf(mesh)); }

template <class Point> bool sameBits(const Point& a, const Point& b) {
    using Bytes = std::array<unsigned char, sizeof(Point)>;
    return std::bit_cast<Bytes>(a) == std::bit_cast<Bytes>(b);
}

// Have all triangles the corners that they had, to the last bit?
template <class Point>
bool haveSameCorners(const MeshGeometry& now, const RawVector<Point>& pointsNow,
                     const MeshGeometry& before, const RawVector<Point>& pointsBefore) {
    if (now.triangles.size() != before.triangles.size()) return false;
    for (std::size_t i = 0; i < now.triangles.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            if (!sameBits(pointsNow[now.triangles[i][corner]],
                          pointsBefore[before.triangles[i][corner]]))
                return false;
    return true;
}

} // namespace

// 5120 triangles of 2562 points, written as 15360.
TEST(share_points_finds_those_of_a_closed_mesh) {
    const MeshDesc whole = meshes::icosphere(4);
    const MeshGeometry before = placed(apart(whole));
    MeshGeometry mesh = before;
    sharePoints(mesh);
    CHECK_EQUAL(before.points.size(), 3 * whole.triangles.size());
    CHECK_EQUAL(mesh.points.size(), whole.points.size());
    CHECK(haveSameCorners(mesh, mesh.points, before, before.points));
    const MeshGeometry once = mesh;
    sharePoints(mesh); // finds nothing more
    CHECK(mesh.points == once.points && mesh.triangles == once.triangles);
}

// The tree over them is that of the mesh with shared corners.
TEST(share_points_gives_the_tree_of_the_shared_mesh) {
    for (const Isa& kernel : allIsas()) {
        if (kernel.triangles == nullptr) continue; // the scalar one has another tree
        MeshGeometry shared = placed(meshes::icosphere(4)),
                     loose = placed(apart(meshes::icosphere(4)));
        shared.finish(true, kernel), loose.finish(true, kernel);
        CHECK_INFO(loose.wide.leaves == shared.wide.leaves && loose.wide.nodes == shared.wide.nodes,
                   kernel.name << ": " << loose.wide.leaves << " and " << shared.wide.leaves
                               << " leaves");
        CHECK(shared.wide.leaves > 0);
    }
}

// 245760 points, divided among threads by their hashes.
TEST(share_points_is_the_same_for_any_number_of_threads) {
    const MeshDesc whole = meshes::icosphere(6);
    MeshGeometry one = placed(apart(whole));
    const MeshGeometry before = one;
    sharePoints(one, 1);
    CHECK_EQUAL(one.points.size(), whole.points.size());
    for (const int threads : {2, 3, 7}) {
        MeshGeometry several = before;
        sharePoints(several, threads);
        CHECK_INFO(several.points == one.points && several.triangles == one.triangles,
                   threads << " threads");
    }
}

// Those of instances by their exact places: what is one point only when it is rounded stays two.
TEST(share_points_asks_for_exact_places) {
    MeshDesc desc = apart(meshes::icosphere(4));
    for (std::size_t i = 0; i < desc.points.size(); i += 3) desc.points[i].x += 1e-14;
    const MeshGeometry before = toSharedGeometry(desc);
    MeshGeometry mesh = before;
    sharePoints(mesh);
    CHECK(mesh.exactPoints.size() < before.exactPoints.size() * 2 / 3);
    CHECK_EQUAL(mesh.points.size(), mesh.exactPoints.size());
    CHECK(haveSameCorners(mesh, mesh.exactPoints, before, before.exactPoints));
    CHECK(haveSameCorners(mesh, mesh.points, before, before.points));
}

// Triangles that share nothing, and a closed mesh that shares already, are left as they are.
TEST(share_points_leaves_others_alone) {
    meshes::Random random(61);
    const auto keeps = [](const MeshGeometry& before) {
        MeshGeometry mesh = before;
        sharePoints(mesh);
        return mesh.points == before.points && mesh.triangles == before.triangles;
    };
    MeshDesc far;
    for (std::uint32_t n = 0; n < 3000; ++n) {
        for (int corner = 0; corner < 3; ++corner) far.points.push_back(random.inBox(1));
        far.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    CHECK_INFO(keeps(placed(far)), "seed 61");
    CHECK(keeps(placed(meshes::torus(0.3, 40, 20))));
}

// 0 and -0 are one place and two numbers: a corner keeps the one that it has.
TEST(share_points_keeps_the_signs_of_zeros) {
    MeshGeometry mesh;
    for (std::uint32_t n = 0; n < 8; ++n) {
        const float zero = n % 2 == 0 ? 0.0f : -0.0f;
        for (const Vec3 p : {Vec3{zero, 0, 0}, Vec3{1, 0, zero}, Vec3{0, 1, 0}})
            mesh.points.push_back(p);
        mesh.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    const MeshGeometry before = mesh;
    sharePoints(mesh);
    CHECK_EQUAL(mesh.points.size(), std::size_t{5});
    CHECK(haveSameCorners(mesh, mesh.points, before, before.points));
}

} // namespace test_share_points
