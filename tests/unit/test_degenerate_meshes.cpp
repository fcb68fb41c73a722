// Triangles without area: which of them a mesh drops, and that its lists stay in step.
#include "check.h"
#include "shape/mesh.h"
#include "verify/meshes.h"

namespace test_degenerate_meshes {

using meshes::Random;

TEST(mesh_drops_triangles_whose_corners_coincide) {
    MeshDesc desc;
    // The last point is on the edge from 0 to 1.
    desc.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0, 0}};
    desc.uvs.resize(4, {});
    desc.triangles = {{0, 1, 2}, {0, 1, 4}, {1, 1, 2}, {0, 2, 3}, {3, 3, 3}};
    desc.uvTriangles = {{0, 1, 2}, {0, 0, 0}, {0, 0, 0}, {0, 2, 3}, {0, 0, 0}};
    desc.triangleMaterials = {0, 1, 1, 2, 1};
    MeshGeometry g = toGeometry(desc, {});
    CHECK_EQUAL(g.dropDegenerate(), 3u);
    // The one with its corners on a line closes the gap between its neighbours.
    CHECK(g.triangles == (std::vector<MeshGeometry::Corners>{{0, 1, 2}, {0, 1, 4}, {0, 2, 3}}));
    CHECK(g.uvTriangles == (std::vector<MeshGeometry::Corners>{{0, 1, 2}, {0, 0, 0}, {0, 2, 3}}));
    CHECK(g.slots == (std::vector<std::uint32_t>{0, 1, 2}) && g.normalTriangles.empty());
    CHECK_EQUAL(g.dropDegenerate(), 1u);

    // Those with the smallest area stay: two floats apart in one coordinate.
    MeshGeometry thin;
    thin.points = {{0, 0, 0}, {1, 1, 1}, {1, 1, nextUp(1.0f)}};
    thin.triangles = {{0, 1, 2}};
    CHECK_EQUAL(thin.dropDegenerate(), 0u);

    // Nothing is left: no box, no hit, no trouble.
    MeshGeometry none;
    none.points = {{1, 2, 3}};
    none.triangles = {{0, 0, 0}};
    CHECK_EQUAL(none.dropDegenerate(), 1u);
    none.finish(true);
    const Mesh empty(none, {0}, {{0, 0}});
    Hit hit;
    const Ray ray{{0, 0, 0}, {1, 2, 3}};
    CHECK(empty.bounds().isEmpty() && !empty.intersect(ray, hit));
}

// What is left of each list is what a plain copy keeps, wherever the dropped ones lie and however
// many threads look for them.
TEST(mesh_drops_the_same_rows_of_every_list) {
    Random random(173);
    for (const double bad : {0.0, 1e-4, 0.5, 0.999, 1.0}) {
        MeshGeometry g, kept;
        g.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
        for (std::uint32_t i = 0; i < 20000; ++i) {
            const bool isBad = random.chance(bad);
            const MeshGeometry::Corners corners =
                isBad ? MeshGeometry::Corners{1, 0, 3} : MeshGeometry::Corners{0, 1, 2};
            const MeshGeometry::Corners row = {i, i + 1, i + 2};
            for (MeshGeometry* to : {&g, &kept}) {
                if (isBad && to == &kept) continue;
                to->triangles.push_back(corners);
                to->uvTriangles.push_back(row);
                to->slots.push_back(i);
            }
        }
        for (const int threads : {1, 3}) {
            MeshGeometry copy = g;
            CHECK_EQUAL(copy.dropDegenerate(threads), g.triangles.size() - kept.triangles.size());
            CHECK(copy.triangles == kept.triangles && copy.uvTriangles == kept.uvTriangles);
            CHECK(copy.slots == kept.slots && copy.normalTriangles.empty());
        }
    }
    std::printf("seed 173\n");
}

} // namespace test_degenerate_meshes
