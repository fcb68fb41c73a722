// Merging meshes: winding under mirrors, slots, parts, and what lists are made up.
#include "scene/merge.h"

#include "base/math.h"
#include "check.h"
#include "verify/meshes.h"

namespace test_merge {

using meshes::Random;
using Corners = MeshGeometry::Corners;

namespace {

double volume(const MeshGeometry& g) { // positive when counter-clockwise is outside
    double sum = 0;
    for (const Corners& c : g.triangles)
        sum += dot(toDouble(g.points[c[0]]),
                   cross(toDouble(g.points[c[1]]), toDouble(g.points[c[2]])));
    return sum / 6;
}

MeshDesc triangle() {
    MeshDesc mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

} // namespace

TEST(merge_keeps_outside_outside) {
    Random random(111);
    int mirrored = 0;
    for (int n = 0; n < 50; ++n) {
        const Transform map = random.affine(3, 1);
        mirrored += map.mirrors();
        MergedMesh merged;
        merged.add(meshes::uvSphere(24, 12), map, {0}, 0);
        const MeshGeometry& g = merged.geometry;
        const double expected = std::fabs(map.determinant()) * 4 / 3 * kPi;
        CHECK_NEAR(volume(g) / expected, 0.96, 0.03); // inscribed
        // Normals and coordinates went with their corners.
        const Transform back = map.inverse();
        for (std::size_t i = 0; i < g.triangles.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3d q = back.point(toDouble(g.points[g.triangles[i][k]])); // on the sphere
                const Vec3 normal = g.normals[g.normalTriangles[i][k]];
                CHECK(length(toDouble(normal) - normalize(map.normal(q))) < 1e-4);
                CHECK_NEAR(g.uvs[g.uvTriangles[i][k]].y,
                           0.5 + std::asin(clamp(q.z, -1.0, 1.0)) / kPi, 1e-3);
            }
        }
    }
    CHECK(mirrored > 10 && mirrored < 40);
}

TEST(merge_slots_and_parts) {
    MeshDesc two = triangle();
    two.points.push_back({1, 1, 0});
    two.triangles = {{0, 1, 2}, {2, 1, 3}, {1, 1, 1}};
    two.triangleMaterials = {1, 0, 1};
    MergedMesh merged;
    merged.add(two, {}, {10, 11}, 4);
    merged.add(triangle(), Transform::translate({0, 0, 1}), {12}, 6);
    MeshDesc flat = triangle();
    flat.points[2] = flat.points[1];
    merged.add(flat, {}, {99}, 7); // nothing is left of it
    merged.add(two, Transform::translate({0, 0, 2}), {13, 14}, 9);
    const MeshGeometry& g = merged.geometry;
    CHECK_EQUAL(merged.degenerateCount, 3u);
    CHECK_EQUAL(g.triangles.size(), 5u);
    CHECK(merged.parts.size() == 3);
    CHECK(merged.parts[0].firstTriangle == 0 && merged.parts[0].object == 4);
    CHECK(merged.parts[1].firstTriangle == 2 && merged.parts[1].object == 6);
    CHECK(merged.parts[2].firstTriangle == 3 && merged.parts[2].object == 9);
    const std::uint32_t expected[] = {11, 10, 12, 14, 13};
    for (std::size_t i = 0; i < 5; ++i) CHECK_EQUAL(merged.materials[g.slots[i]], expected[i]);
    const float depth[] = {0, 0, 1, 2, 2};
    for (std::size_t i = 0; i < 5; ++i)
        for (const std::uint32_t c : g.triangles[i]) CHECK_EQUAL(g.points[c].z, depth[i]);
    // And the shape that is made of it says the same.
    MeshGeometry copy = g;
    copy.finish(true);
    const Mesh mesh(copy, merged.materials, merged.parts);
    const Ray ray{{0.25f, 0.25f, 1.5f}, {0, 0, -1}};
    Hit hit;
    CHECK(mesh.intersect(ray, hit) && hit.prim == 2);
    CHECK(mesh.surface(ray, hit).material == 12 && mesh.surface(ray, hit).object == 6);
}

// The first material is told by no list, until a mesh has another one.
TEST(merge_lists_slots_where_there_are_several) {
    MergedMesh merged;
    merged.add(triangle(), {}, {}, 0); // of no material, for which nothing is counted
    merged.add(triangle(), {}, {7}, 1);
    CHECK(merged.geometry.slots.empty());
    merged.add(triangle(), {}, {8}, 2);
    CHECK(merged.geometry.slots == (std::vector<std::uint32_t>{0, 0, 1}));
    CHECK(merged.materials == (std::vector<std::uint32_t>{7, 8}));
    MergedMesh several;
    MeshDesc second = triangle();
    second.triangleMaterials = {1};
    several.add(second, {}, {}, 0);
    several.add(triangle(), {}, {}, 1);
    CHECK(several.geometry.slots == (std::vector<std::uint32_t>{1, 0}));
}

// Of meshes with and without normals or coordinates each looks as it does alone.
TEST(merge_marks_what_is_missing) {
    const MeshDesc smooth = meshes::uvSphere(8, 4);
    for (const bool smoothFirst : {true, false}) {
        MergedMesh merged;
        if (smoothFirst) merged.add(smooth, {}, {0}, 0);
        merged.add(triangle(), Transform::scale({1, 1, -1}), {0}, 1);
        if (!smoothFirst) merged.add(smooth, {}, {0}, 0);
        const MeshGeometry& g = merged.geometry;
        const std::size_t lone = smoothFirst ? g.triangles.size() - 1 : 0;
        CHECK(g.normalTriangles.size() == g.triangles.size());
        CHECK(g.uvTriangles.size() == g.triangles.size() && g.slots.size() == g.triangles.size());
        CHECK(g.normalTriangles[lone] == MeshGeometry::kWithout);
        CHECK(g.uvTriangles[lone] == MeshGeometry::kWithout);
        MeshGeometry copy = g;
        copy.finish(true);
        const Mesh mesh(copy, merged.materials, merged.parts);
        const Ray ray{{0.25f, 0.25f, -3}, {0, 0, 3}, 0.9f};
        std::vector<Hit> hits;
        mesh.collect(ray, hits);
        std::erase_if(hits, [&](const Hit& hit) { return hit.prim != lone; });
        CHECK_EQUAL(hits.size(), 1u);
        const Surface s = mesh.surface(ray, hits.at(0));
        CHECK(s.ns == (Vec3{0, 0, -1}) && s.lift == Vec3{}); // mirrored: it faces down
        CHECK(s.uv == (Vec2{hits[0].u, hits[0].v}));
        for (std::size_t i = 0; i < g.triangles.size(); ++i) {
            if (i == lone) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(length(g.normals[g.normalTriangles[i][k]] - g.points[g.triangles[i][k]]) <
                      1e-6f);
                CHECK_NEAR(g.uvs[g.uvTriangles[i][k]].y,
                           0.5 + std::asin(clamp(static_cast<double>(g.points[g.triangles[i][k]].z),
                                                 -1.0, 1.0)) /
                                     kPi,
                           1e-3);
            }
        }
    }
    // Two without stay without.
    MergedMesh plain;
    plain.add(triangle(), {}, {0}, 0);
    plain.add(triangle(), {}, {0}, 1);
    CHECK(plain.geometry.normals.empty() && plain.geometry.uvs.empty());
    CHECK(MergedMesh().geometry.triangles.empty());
}

TEST(merge_places_in_double) {
    // 2^-30 apart at 1e5: gone in float, kept by subtracting the centre first.
    MeshDesc mesh = triangle();
    const SceneFrame frame{{1e5, 1e5, 1e5}, 0x1p20};
    for (Vec3d& p : mesh.points) p = p * 0x1p-30 + Vec3d{1e5, 1e5, 1e5};
    const MeshGeometry g = toGeometry(mesh, frame);
    CHECK(g.points[0] == (Vec3{0, 0, 0}) && g.points[1] == (Vec3{0x1p-10f, 0, 0}) &&
          g.points[2] == (Vec3{0, 0x1p-10f, 0}));
    MergedMesh merged;
    merged.add(mesh, frame.placed(Transform().rows()), {0}, 0);
    CHECK(merged.geometry.points == g.points && merged.degenerateCount == 0);
}

} // namespace test_merge
