// Promise P2: closed meshes do not leak. The rows of the battery (Code/verify/leaks.cpp) at a small
// size, and what their truth rests on: that the meshes are closed, and the points inside are
// inside.
#include "check.h"
#include "verify/groups.h"
#include "verify/placed_solid.h"

#include <algorithm>
#include <map>

namespace test_watertight {

using meshes::Random;

namespace {

// Every edge once in each direction: closed, with all faces to one side.
bool isClosed(const MeshDesc& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& c : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) ++edges[{c[i], c[(i + 1) % 3]}];
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        const auto back = edges.find({edge.first.second, edge.first.first});
        return edge.second == 1 && back != edges.end() && back->second == 1;
    });
}

} // namespace

TEST(watertight_solids_are_closed) {
    for (const battery::Solid& solid : battery::solids())
        CHECK_INFO(isClosed(solid.mesh), solid.name);
    MeshDesc open = meshes::cube();
    open.triangles.pop_back();
    CHECK(!isClosed(open));
}

// By the solid angle of all faces, which is 4 pi around a point inside and 0 around one outside
// (Van Oosterom and Strackee 1983).
TEST(watertight_inside_is_inside) {
    Random random(40);
    const auto solidAngle = [](const MeshDesc& mesh, Vec3d from) {
        double sum = 0;
        for (const auto& t : mesh.triangles) {
            const Vec3d a = mesh.points[t[0]] - from, b = mesh.points[t[1]] - from,
                        c = mesh.points[t[2]] - from;
            const double la = length(a), lb = length(b), lc = length(c);
            sum += 2 * std::atan2(dot(a, cross(b, c)),
                                  la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
        }
        return sum;
    };
    for (const battery::Solid& solid : battery::solids()) {
        for (int i = 0; i < 5; ++i) {
            const Vec3d p = battery::inside(random, solid);
            CHECK_NEAR(solidAngle(solid.mesh, p), 4 * kPi, 1e-6);
            CHECK_NEAR(solidAngle(solid.mesh, p + Vec3d{0, 0, 2.5}), 0, 1e-6);
        }
    }
}

TEST(watertight_from_inside) {
    for (const battery::Row& row : battery::leakRows()) {
        const battery::Tally tally = row.run({check::scaled(0.1), 1});
        CHECK_INFO(battery::passed(row, tally),
                   row.id << ' ' << row.what << ": " << tally.failedCase << tally.worstCase);
    }
}

} // namespace test_watertight
