// What the NFF reader makes of spheres, cones, polygons and patches, in numbers worked out by hand.
#include "base/math.h"
#include "base/transform.h"
#include "read/nff/terms.h"
#include "unit/nff_kit.h"

#include <cmath>
#include <random>

namespace test_nff_shapes {

using nff_kit::checkPoint;
using nff_kit::kFill;
using nff_kit::kView;
using nff_kit::Read;
using nff_kit::readBody;
using nff_kit::readWhole;

namespace {

using Kind = ObjectDesc::Kind;
using Sides = ObjectDesc::Sides;

Vec3d areaVector(const MeshDesc& mesh, std::size_t triangle) {
    const MeshDesc::Corners& t = mesh.triangles.at(triangle);
    return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]) *
           0.5;
}

} // namespace

TEST(read_nff_sphere) {
    const SceneDesc desc =
        readBody(kFill + "s 1 2 3 0.5 s 1 2 3 -4 f 1 1 1 0 0 1 1 1.5 s 0 0 0 -1");
    CHECK(desc.objects.at(0).kind == Kind::Sphere);
    checkPoint(Transform::fromRows(desc.objects[0].worldFromObject.at(0)).translation(), {1, 2, 3},
               0);
    CHECK(desc.objects[0].radius == 0.5 && desc.objects[0].sides == Sides::Both);
    CHECK(desc.objects.at(1).radius == 4 && desc.objects[1].sides == Sides::Back);
    CHECK(desc.objects.at(2).radius == 1 && desc.objects[2].sides == Sides::Both);
}

TEST(read_nff_cone) {
    const SceneDesc desc = readBody(kFill + "c 1 2 3 0.5  1 2 7 0.25  c 1 2 3 0.5  4 6 3 0.5\n"
                                            "c 0 0 0 -1  0 0 1 0  c 0 0 0 0  0 0 1 2\n"
                                            "f 1 1 1 0 0 1 0.5 1.5 c 0 0 0 1  0 0 1 1\n");
    const ObjectDesc& cone = desc.objects.at(0);
    CHECK(cone.kind == Kind::Cone && !cone.caps && cone.sides == Sides::Both);
    CHECK(cone.radius == 0.5 && cone.topRadius == 0.25);
    const Transform worldFromCone = Transform::fromRows(cone.worldFromObject.at(0));
    checkPoint(worldFromCone.point({0, 0, -1}), {1, 2, 3}, 0);
    checkPoint(worldFromCone.point({0, 0, 1}), {1, 2, 7}, 0);
    const ObjectDesc& cylinder = desc.objects.at(1);
    CHECK(cylinder.kind == Kind::Cylinder && !cylinder.caps && cylinder.sides == Sides::Both);
    CHECK_EQUAL(cylinder.radius, 0.5);
    checkPoint(Transform::fromRows(cylinder.worldFromObject.at(0)).point({0, 0, 1}), {4, 6, 3},
               1e-15);
    CHECK(desc.objects.at(2).kind == Kind::Cone && desc.objects[2].sides == Sides::Back);
    CHECK(desc.objects[2].radius == 1 && desc.objects[2].topRadius == 0);
    CHECK(desc.objects.at(3).radius == 0 && desc.objects[3].topRadius == 2);
    CHECK(desc.objects.at(4).sides == Sides::Both);
}

// Along any axis, of any size: the ends are where they should be, and the circle stays a circle.
TEST(read_nff_cone_frame) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto point = [&] {
        Vec3d p{coordinate(random), coordinate(random), coordinate(random)};
        for (std::size_t i = 0; i < 3; ++i)
            if (random() % 4 == 0) p[i] = 0; // axes and planes of the world
        return p;
    };
    for (int i = 0; i < check::scaled(2000); ++i) {
        const double size = std::ldexp(1.0, static_cast<int>(random() % 120) - 60);
        const Vec3d base = point() * size, apex = point() * size;
        const auto cone = nffCone(base, size, apex, size / 2);
        CHECK(cone.has_value() == (base != apex));
        if (!cone) continue;
        const Transform world = Transform::fromRows(cone->worldFromObject.at(0));
        CHECK_INFO(!world.isSingular() && !world.mirrors(), "case " << i);
        checkPoint(world.point({0, 0, -1}), base, 4e-16 * size);
        checkPoint(world.point({0, 0, 1}), apex, 4e-16 * size);
        const Vec3d x = world.column(0), y = world.column(1), z = world.column(2);
        CHECK_INFO(std::fabs(length(x) - 1) < 1e-15 && std::fabs(length(y) - 1) < 1e-15,
                   "case " << i);
        CHECK_INFO(std::fabs(dot(x, y)) < 1e-15 && std::fabs(dot(x, z)) < 1e-15 * length(z) &&
                       std::fabs(dot(y, z)) < 1e-15 * length(z),
                   "case " << i);
    }
}

TEST(read_nff_polygon) {
    // A chevron of area 1.5 in the plane y = -3, counter-clockwise seen from -y; its notch is
    // corner 3.
    const SceneDesc desc = readBody(kFill + "p 5  0 -3 0  2 -3 0  2 -3 1  1 -3 0.5  0 -3 1\n"
                                            "s 9 9 9 1\n"
                                            "p 3  0 0 0  1 0 0  0 1 0\n");
    CHECK_EQUAL(desc.objects.size(), std::size_t{2}); // one mesh of one fill
    const ObjectDesc& object = desc.objects.at(0);
    CHECK(object.kind == Kind::Mesh && object.mesh == 0 && object.sides == Sides::Both);
    const MeshDesc& mesh = desc.meshes.at(0);
    CHECK_EQUAL(mesh.points.size(), std::size_t{8});
    CHECK_EQUAL(mesh.triangles.size(), std::size_t{4});
    double area = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(areaVector(mesh, i).y < 0); // none lies in the notch, turned round
        area -= areaVector(mesh, i).y;
    }
    CHECK_NEAR(area, 1.5, 1e-15);
    CHECK((mesh.triangles[3] == MeshDesc::Corners{5, 6, 7}));
    CHECK((mesh.points[6] == Vec3d{1, 0, 0}));
    CHECK(mesh.normals.empty() && mesh.normalTriangles.empty());
}

TEST(read_nff_patch) {
    const SceneDesc desc = readBody("f 1 1 1 1 0 1 0.5 1\n"
                                    "p 3 0 0 0 1 0 0 0 1 0\n"
                                    "pp 3 0 0 0 0 0 1  1 0 0 0.6 0 0.8  0 1 0 0 0.6 0.8\n");
    CHECK_EQUAL(desc.objects.size(), std::size_t{2});
    CHECK_EQUAL(desc.objects.at(1).name, "patches1");
    CHECK(desc.objects[1].sides == Sides::Both && desc.objects[0].sides == Sides::Both);
    const MeshDesc& mesh = desc.meshes.at(1);
    CHECK(mesh.triangles == mesh.normalTriangles && mesh.triangles.size() == 1);
    CHECK((mesh.normals.at(1) == Vec3{0.6f, 0, 0.8f}));
    CHECK((mesh.points.at(2) == Vec3d{0, 1, 0}));
}

TEST(read_nff_what_shows_nothing) {
    const Read read = readWhole(kView + kFill +
                                "p 2 0 0 0 1 0 0\n"
                                "p 0\n"
                                "p 3 0.1 0.1 0.1 0.2 0.2 0.2 0.3 0.3 0.3\n"
                                "p 4 1 2 3 1 2 3 1 2 3 1 2 3\n"
                                "s 1 2 3 0\n"
                                "c 1 2 3 1 1 2 3 2\n"
                                "c 1 2 3 0 1 2 4 0\n"
                                "s 1 2 3 1\n");
    CHECK_EQUAL(read.desc.objects.size(), std::size_t{1});
    CHECK(read.desc.meshes.empty());
    CHECK_EQUAL(read.warnings.size(), std::size_t{3});
    const std::string all = join(read.warnings);
    CHECK_INFO(all.find("t.nff:3:1: warning: 4 polygons without an area were left out; this is the "
                        "first") != std::string::npos,
               all);
    CHECK_INFO(all.find("t.nff:7:1: warning: a sphere of radius 0 was left out") !=
                   std::string::npos,
               all);
    CHECK_INFO(all.find("t.nff:8:1: warning: 2 cones without height or radius were left out") !=
                   std::string::npos,
               all);
    // Thin is not flat: a triangle a millionth as high as it is wide, far away from the origin.
    CHECK_EQUAL(readBody(kFill + "p 3 1000 0 0 1001 0 0 1000 1e-6 0").objects.size(),
                std::size_t{1});
}

} // namespace test_nff_shapes
