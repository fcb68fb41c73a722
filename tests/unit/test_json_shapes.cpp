// Shapes in JSON: where the dialects place them and their materials.
#include "unit/json_kit.h"

namespace test_json_shapes {

using json_kit::checkPoint;
using json_kit::hasWarning;
using json_kit::objects;
using json_kit::Reading;
using json_kit::readObjects;
using json_kit::scene;
using json_kit::worldPoint;

TEST(read_json_box) {
    const auto checkBox = [](const std::string& body, Vec3d lo, Vec3d hi) {
        const ObjectDesc box = objects(cat(R"({"type": "box")", body, "}")).at(0);
        CHECK(box.kind == ObjectDesc::Kind::Cube);
        checkPoint(worldPoint(box, {-1, -1, -1}), lo);
        checkPoint(worldPoint(box, {1, 1, 1}), hi);
    };
    checkBox("", {-1, -1, -1}, {1, 1, 1});
    checkBox(R"(, "size": [2, 4, 6], "position": [1, 1, 1])", {0, -1, -2}, {2, 3, 4});
    checkBox(R"(, "min": [-1, 0, -1], "max": [1, 2, 3])", {-1, 0, -1}, {1, 2, 3});
    checkBox(R"(, "max": [1, 5, 1])", {-1, -1, -1}, {1, 5, 1});
    checkBox(R"(, "rotation": [0, 45, 0])", {-1, -1, -1}, {1, 1, 1});
    CHECK(hasWarning(readObjects(R"({"type": "box", "rotation": [0, 45, 0]})"),
                     "'rotation' of a box is ignored"));
    CHECK(readObjects(R"({"type": "box", "rotation": [0, 0, 0]})").warnings.empty());
    CHECK(hasWarning(readObjects(R"({"type": "box", "min": [-2, -2, -2], "position": [1, 0, 0]})"),
                     "'position' of a box without 'size' is ignored"));
    // A cube is turned.
    checkPoint(worldPoint(objects(R"({"type": "cube", "rotation": [0, 90, 0]})").at(0), {1, 0, 0}),
               {0, 0, -1});
}

TEST(read_json_plane) {
    const ObjectDesc floor =
        objects(R"({"type": "plane", "normal": [0, 2, 0], "position": [3, -1, 5],
                 "materials": [0]})")
            .at(0);
    const Transform t = Transform::fromRows(floor.worldFromObject.at(0));
    checkPoint(t.point({}), {3, -1, 5});
    checkPoint(normalize(t.normal({0, 0, 1})), {0, 1, 0});
    CHECK(!t.mirrors());
    for (const std::string normal : {"[1, 2, -2]", "[0, -1, 0]", "[1, 0, 0]", "[0, 0, -3]"}) {
        const ObjectDesc plane =
            objects(cat(R"({"type": "plane", "position": [1, 2, 3], "normal": )", normal, "}"))
                .at(0);
        const Transform p = Transform::fromRows(plane.worldFromObject.at(0));
        const Vec3d x = p.vector({1, 0, 0}), y = p.vector({0, 1, 0}), z = p.vector({0, 0, 1});
        CHECK_NEAR(dot(x, x), 1, 1e-15);
        CHECK_NEAR(dot(y, y), 1, 1e-15);
        CHECK_NEAR(dot(x, y), 0, 1e-15);
        checkPoint(cross(x, y), z);
    }
}

// The first material is where floor(x) + floor(z) of the world is even; the renderer alternates on
// x and y of the object. The point of the plane does not count.
TEST(read_json_checkerboard) {
    for (const Vec3d normal : {Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0.3, 1, -0.2},
                               Vec3d{-2, 0.5, 1}, Vec3d{1, -1, 1}}) {
        const Vec3d position{0.25, -1.5, 7.75};
        const ObjectDesc plane =
            objects(cat(R"({"type": "plane", "position": [0.25, -1.5, 7.75], "normal": [)",
                        normal.x, ", ", normal.y, ", ", normal.z, R"(], "materials": [0, 1]})"))
                .at(0);
        CHECK((plane.materials == std::vector<Handle>{0, 1}));
        const Transform t = Transform::fromRows(plane.worldFromObject.at(0));
        checkPoint(normalize(t.normal({0, 0, 1})), normalize(normal));
        for (const Vec2d xz :
             {Vec2d{0.5, 0.5}, Vec2d{-0.5, -0.5}, Vec2d{0.5, -0.5}, Vec2d{-3.25, 4.5}}) {
            const double y =
                position.y -
                ((xz.x - position.x) * normal.x + (xz.y - position.z) * normal.z) / normal.y;
            const Vec3d world{xz.x, y, xz.y};
            checkPoint(t.inverse().point(world), {xz.x, xz.y, 0}, 1e-11);
        }
    }
    // In a node the squares are those of its own x and z.
    const ObjectDesc inNode = objects(R"({"type": "node", "position": [0.5, 0, 0], "scale": 2,
        "materials": [0, 1], "children": [{"type": "plane", "position": [9, 1, 9]}]})")
                                  .at(0);
    checkPoint(worldPoint(inNode, {1, 3, 0}), {2.5, 2, 6});
    const Reading wall =
        readObjects(R"({"type": "plane", "normal": [1, 0, 0], "materials": [0, 1]})");
    CHECK(hasWarning(wall, "is vertical: squares of x and z would be stripes on it"));
    checkPoint(Transform::fromRows(wall.desc.objects.at(0).worldFromObject.at(0)).vector({0, 1, 0}),
               {0, 1, 0});
}

TEST(read_json_mesh) {
    const auto vertex = [](const std::string& dialect, const std::string& body) {
        const SceneDesc desc = scene(cat("{", dialect, R"("objects": [{"type": "mesh",
            "filepath": "a/torus.obj", )",
                                         body, "}]}"));
        CHECK(desc.objects.at(0).mesh == 0 && desc.meshes.at(0).file == "a/torus.obj");
        CHECK(desc.meshes[0].name == "torus" && desc.meshes[0].points.empty());
        return worldPoint(desc.objects[0], {1, 2, 3});
    };
    const std::string numbered = R"("AA": {"samples": 1},)";
    // (v + position) * scale, or T * R * S.
    checkPoint(vertex(numbered, R"("position": [1, 0, 0], "scale": 2)"), {4, 4, 6});
    checkPoint(vertex("", R"("position": [1, 0, 0], "scale": 2)"), {4, 4, 6});
    checkPoint(vertex(R"("camera": {"position": [0, 0, 9], "fovy": 45},)",
                      R"("position": [1, 0, 0], "scale": 2)"),
               {3, 4, 6});
    checkPoint(vertex(numbered, R"("position": [1, 0, 0], "scale": [2, 1, 1])"), {3, 2, 3});
    checkPoint(vertex("", R"("position": [1, 0, 0], "rotation": [0, 0, 90], "scale": [2, 1, 1])"),
               {-1, 2, 3});
    // The same file is one mesh.
    const SceneDesc desc = scene(R"({"objects": [
        {"type": "mesh", "filepath": "m.obj"}, {"type": "mesh", "filepath": "m.obj"},
        {"type": "mesh", "filepath": "m.obj", "smooth_angle": 30},
        {"type": "mesh", "filepath": "b/m.obj"}]})");
    CHECK_EQUAL(desc.meshes.size(), std::size_t{3});
    CHECK_EQUAL(desc.objects.at(1).mesh, 0);
    CHECK_EQUAL(desc.meshes.at(1).smoothAngleDeg, 30.0);
    CHECK_EQUAL(desc.meshes.at(2).name, "m.3");
}

// Disks, cylinders and cones stand on the plane of x and z.
TEST(read_json_upright_shapes) {
    for (const std::string type : {"disk", "cylinder", "cone"}) {
        const ObjectDesc shape = objects(cat(R"({"type": ")", type, "\"}")).at(0);
        const Transform t = Transform::fromRows(shape.worldFromObject.at(0));
        checkPoint(t.vector({0, 0, 1}), {0, 1, 0});
        CHECK(!t.mirrors());
    }
    const ObjectDesc quad = objects(R"({"type": "quad", "sides": "front",
        "corners": [[0, 0, 0], [2, 0, 0], [2, 3, 0], [0, 3, 0]]})")
                                .at(0);
    CHECK(quad.kind == ObjectDesc::Kind::Plane && quad.sides == ObjectDesc::Sides::Front);
    checkPoint((*quad.corners)[2], {2, 3, 0}, 0);
}

// In 2025 boxes and planes have the whole transform, and it moves the squares of a checkerboard.
TEST(read_json_everything_is_placed_in_2025) {
    const SceneDesc desc = scene(R"({"camera": {"position": [0, 0, 9], "fovy": 45},
        "materials": [{"name": "a"}, {"name": "b"}], "objects": [
        {"type": "box", "position": [5, 0, 0], "rotation": [0, 90, 0], "scale": 2},
        {"type": "plane", "position": [5, 0, 0], "rotation": [0, 90, 0], "scale": 2,
         "materials": ["a", "b"]}]})");
    checkPoint(worldPoint(desc.objects.at(0), {1, 0, 0}), {5, 0, -2});
    checkPoint(worldPoint(desc.objects.at(1), {1, 0, 0}), {5, 0, -2});
    checkPoint(worldPoint(desc.objects.at(1), {0, 1, 0}), {7, 0, 0});
}

} // namespace test_json_shapes
