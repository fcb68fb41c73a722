// The OBJ reader's faces: their indices, polygons, what is left out, and normals of smoothing
// groups.
#include "read/mesh/mesh_steps.h"
#include "unit/obj_kit.h"

#include <cmath>

namespace test_obj_faces {

using obj_kit::Corners;
using obj_kit::kSquare;
using obj_kit::messageOf;
using obj_kit::normalAt;
using obj_kit::readBody;
using obj_kit::readText;
using obj_kit::Result;
using obj_kit::Triangles;
using obj_kit::uvAt;
using obj_kit::warns;

TEST(read_obj_indices) {
    // Negative ones count from the last that came before the face, positive ones may come after it.
    const Result file =
        readText("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 0\nvn 0 0 1\nf -3/-1/-1 -2/-1/-1 "
                 "-1/-1/-1\nf 4 5 6\nv 0 0 5\nv 1 0 5\nvt 0 1\nv 0 1 5\nf -3 -2 -1\n"
                 "f 1/-1 2/-1 3/-2\n");
    CHECK((file.mesh.triangles == Triangles{{0, 1, 2}, {3, 4, 5}, {3, 4, 5}, {0, 1, 2}}));
    CHECK((uvAt(file.mesh, 0, 0) == Vec2{1, 0}));
    CHECK((uvAt(file.mesh, 3, 0) == Vec2{0, 1}));
    CHECK((uvAt(file.mesh, 3, 2) == Vec2{1, 0}));
    // Slashes without a number, as some programs write them.
    CHECK((readBody("vt 0 0\nf 1/ 2/ 3/\nf 1// 3// 4//\nf 1/1/ 3/1/ 4/1/").mesh.triangles ==
           Triangles{{0, 1, 2}, {0, 2, 3}, {0, 2, 3}}));
    CHECK(messageOf("f 1 2 5").find("t.obj:5:7: error: there is no vertex 5; the file has 4") == 0);
    CHECK(messageOf("f 1 2 -5\nv 0 0 0").find("no vertex -5; only 4 come before") !=
          std::string::npos);
}

TEST(read_obj_polygons) {
    // Convex: the fan of the first corner; an L and a notch as ears, all uvs with their corners.
    std::string text = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
    for (int i = 0; i < 6; ++i) text += cat("vt ", i, " 0\n");
    const Result file = readText(text + "f 1/1 2/2 3/3 4/4 5/5 6/6\nf 6/6 5/5 4/4 3/3 2/2 1/1\n");
    CHECK_EQUAL(file.mesh.triangles.size(), std::size_t{8});
    double area[2] = {0, 0};
    for (std::size_t i = 0; i < 8; ++i) {
        const Corners& t = file.mesh.triangles[i];
        const auto& p = file.mesh.points;
        area[i / 4] += cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z / 2;
        CHECK(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z * (i < 4 ? 1 : -1) > 0);
        for (std::size_t k = 0; k < 3; ++k)
            CHECK_EQUAL(uvAt(file.mesh, i, k).x, static_cast<float>(t[k]));
    }
    CHECK_EQUAL(area[0], 3.0);
    CHECK_EQUAL(area[1], -3.0);
    // The longest face, and one corner more.
    std::string face = "\nf";
    std::string points;
    for (std::size_t i = 0; i <= kMostCorners; ++i) points += cat("v ", i, " ", i * i, " 0\n");
    for (std::size_t i = 1; i <= kMostCorners; ++i) face += cat(" ", i);
    CHECK_EQUAL(readText(points + face).mesh.triangles.size(), kMostCorners - 2);
    CHECK_THROWS(readText(points + face + " 1"), "a face with more than 32768 corners");
}

TEST(read_obj_leaves_out) {
    const Result file = readText("v 9 9 9\n" + kSquare +
                                 "v 0.5 0 0\nvt 7 7\nvt 1 0\nvn 1 0 0\nvn 0 0 1\n"
                                 "f 2 3 6\nf 2 3 2\nf\nf 3\nf 2 2 2 2 2\nf 3/2/2 4/2/2 5/2/2\n");
    CHECK((file.mesh.points == std::vector<Vec3d>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    CHECK((file.mesh.triangles == Triangles{{0, 1, 2}}));
    CHECK((file.mesh.uvs == std::vector<Vec2>{{1, 0}}));
    CHECK((file.mesh.normals == std::vector<Vec3>{{0, 0, 1}}));
    CHECK_EQUAL(file.warnings.size(), std::size_t{1});
    CHECK(warns(file, "t.obj:11:1: warning: left out: 2 faces with fewer than three corners, 3 "
                      "faces without area, 3 vertices that no face uses"));
    // Repeated corners and corners in line leave triangles without area, not the face.
    CHECK_EQUAL(readBody("f 1 1 2 3 3 4").mesh.triangles.size(), std::size_t{2});
    CHECK(readBody("f 1 1 2 3 3 4").warnings.empty());
    CHECK(messageOf("f 1 2 1").find("t.obj:1:1: error: none of the 1 face has three corners and an "
                                    "area") == 0);
    CHECK(messageOf("").find("t.obj:1:1: error: the file has no faces") == 0);
    CHECK_THROWS(readText(""), "t.obj:1:1: error: the file has no faces");
}

TEST(read_obj_smoothing_groups) {
    // A roof: its ridge is smooth in a group, sharp between groups, and given normals stay.
    const std::string roof = "v -1 0 0\nv -1 0 2\nv 0 1 0\nv 0 1 2\nv 1 0 0\nv 1 0 2\nvn 1 0 0\n";
    const float d = std::sqrt(0.5f);
    const auto checkAt = [&](const Result& file, std::size_t triangle, std::size_t corner,
                             Vec3 expected) {
        CHECK(length(normalAt(file.mesh, triangle, corner) - expected) < 1e-6f);
    };
    const Result smooth = readText(roof + "s 5\nf 1 2 4 3\nf 3 4 6 5\n");
    checkAt(smooth, 0, 0, {-d, d, 0});
    checkAt(smooth, 0, 2, {0, 1, 0});
    checkAt(smooth, 2, 0, {0, 1, 0});
    const Result sharp = readText(roof + "s 5\nf 1 2 4 3\ns 6\nf 3 4 6 5\n");
    checkAt(sharp, 0, 2, {-d, d, 0});
    checkAt(sharp, 2, 0, {d, d, 0});
    const Result mixed = readText(roof + "s 1\nf 1 2 4 3\nf 3//1 4//1 6//1 5//1\ns off\nf 1 2 6\n");
    checkAt(mixed, 0, 2, {0, 1, 0});
    checkAt(mixed, 2, 0, {1, 0, 0});
    checkAt(mixed, 4, 0, {0, 1, 0});
    CHECK(readText(roof + "s off\nf 1 2 4 3\ns 0\nf 3 4 6 5\n").mesh.normals.empty());
}

} // namespace test_obj_faces
