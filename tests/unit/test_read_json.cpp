// Scenes in JSON: the dialects of the course with their quirks, by numbers worked out by hand, and
// the keys that are rows of the native tables. What is refused is in tests/bad/json.
#include "read/json/read_json.h"

#include "base/math.h"
#include "base/text.h"
#include "base/transform.h"
#include "check.h"
#include "desc/properties.h"
#include "desc/validate.h"
#include "unit/damage.h"

#include <filesystem>
#include <random>

namespace {

using damage::contentOf;

namespace fs = std::filesystem;

struct Reading {
    SceneDesc desc;
    std::vector<std::string> warnings;
};
Reading read(const std::string& text, bool lenient = false) {
    const SourceFile source{"t.json", text};
    Diagnostics diagnostics;
    ReadOptions options;
    options.lenient = lenient;
    SceneDesc desc = readJson(source, {options, diagnostics});
    return {std::move(desc), std::move(diagnostics.warnings)};
}
SceneDesc scene(const std::string& text) { return read(text).desc; }
// A scene of these objects, with materials a and b of the IDs 0 and 1.
const std::string kMaterials =
    R"("materials": [{"name": "a", "ID": 0, "hardness": 1}, {"name": "b", "ID": 1}],)";
Reading readObjects(const std::string& objects) {
    return read(cat("{", kMaterials, "\"objects\": [", objects, "]}"));
}
std::vector<ObjectDesc> objects(const std::string& text) { return readObjects(text).desc.objects; }
LightDesc light(const std::string& scene_, const std::string& body) {
    return scene(cat("{", scene_, "\"lights\": [{", body, "}]}")).lights.at(0);
}

Vec3d worldPoint(const ObjectDesc& object, Vec3d p) {
    return Transform::fromRows(object.worldFromObject.at(0)).point(p);
}
void checkPoint(Vec3d got, Vec3d expected, double tolerance = 1e-12) {
    CHECK_NEAR(got.x, expected.x, tolerance);
    CHECK_NEAR(got.y, expected.y, tolerance);
    CHECK_NEAR(got.z, expected.z, tolerance);
}
void checkColor(Rgbd got, Rgbd expected) {
    checkPoint({got.r, got.g, got.b}, {expected.r, expected.g, expected.b}, 1e-15);
}
// The axis along which a light shines.
Vec3d shines(const LightDesc& l) {
    return normalize(Transform::fromRows(l.worldFromLight).vector({0, 0, -1}));
}
bool hasWarning(const Reading& reading, const std::string& words) {
    return join(reading.warnings, "\n").find(words) != std::string::npos;
}
} // namespace

TEST(read_json_defaults) {
    const SceneDesc desc = scene("{}");
    CHECK_EQUAL(desc.settings.width, 1280);
    CHECK_EQUAL(desc.settings.height, 720);
    CHECK_EQUAL(desc.settings.samplesPerPixel, 1);
    CHECK(desc.settings.sampler == SettingsDesc::Sampler::Grid && !desc.settings.jitter);
    CHECK(desc.settings.filter == SettingsDesc::Filter::Box && desc.settings.filterWidth == 1);
    CHECK(desc.settings.transfer == SettingsDesc::Transfer::Linear);
    CHECK_EQUAL(desc.settings.maxDepth, SettingsDesc{}.maxDepth);
    checkColor(desc.world.ambient, {0.1, 0.1, 0.1});
    checkColor(desc.world.background, {0, 0, 0});
    CHECK(desc.world.environmentUp == WorldDesc::Up::Y);
    CHECK(desc.cameras.empty() && desc.lights.empty() && desc.objects.empty());
}

// The programs of 2022 need both keys of AA; a scene that has both may be theirs.
TEST(read_json_resolution_of_the_dialects) {
    const auto widthOf = [](const std::string& text) { return scene(text).settings.width; };
    CHECK_EQUAL(widthOf(R"({"AA": {"jitter": false, "samples": 1}})"), 1080);
    CHECK_EQUAL(widthOf(R"({"AA": {"samples": 1}})"), 1280);
    CHECK_EQUAL(widthOf(R"({"AA_samples": 1, "AA_jitter": true})"), 1280);
    CHECK_EQUAL(widthOf(R"({"AA": {"jitter": false, "samples": 1}, "resolution": [64, 32]})"), 64);
}

TEST(read_json_anti_aliasing) {
    for (const std::string aa :
         {R"("AA": {"jitter": true, "samples": 3})", R"("AA_jitter": true, "AA_samples": 3)"}) {
        const SettingsDesc s = scene(cat("{", aa, "}")).settings;
        CHECK_EQUAL(s.samplesPerPixel, 9);
        CHECK(s.sampler == SettingsDesc::Sampler::Grid && s.jitter);
    }
    // Samples counted in the native way get the native pattern.
    const SettingsDesc s = scene(R"({"settings": {"samples": 8, "seed": 7}})").settings;
    CHECK_EQUAL(s.samplesPerPixel, 8);
    CHECK(s.sampler == SettingsDesc::Sampler::Sobol && s.jitter && s.seed == 7);
    CHECK_THROWS(scene(R"({"AA_samples": 2, "settings": {"samples": 8}})"), "give one");
}

TEST(read_json_camera) {
    for (const std::string key : {"fov", "fovy"}) {
        const CameraDesc camera =
            scene(cat(R"({"camera": {"position": [1, 2, 10], "lookAt": [1, 2, 0],
                      "up": [0, 2, 0], ")",
                      key, "\": 60}}"))
                .cameras.at(0);
        CHECK(camera.sensorFit == CameraDesc::SensorFit::Vertical);
        CHECK_NEAR(camera.sensorHeightMm / 2 / camera.lensMm, std::tan(kPi / 6), 1e-15);
        // w = (0,0,1), u = up x w = (1,0,0), v = w x u = (0,1,0).
        const Rows expected = {1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 10};
        for (std::size_t i = 0; i < 12; ++i)
            CHECK_NEAR(camera.worldFromCamera.at(0)[i], expected[i], 1e-15);
    }
    // Askew: from (3,0,0) to the origin with up z, the right is +y: up x w = z x x = y.
    const CameraDesc side =
        scene(R"({"camera": {"position": [3, 0, 0], "lookAt": [0, 0, 0], "up": [1, 0, 1]}})")
            .cameras.at(0);
    const Rows expected = {0, 0, 1, 3, 1, 0, 0, 0, 0, 1, 0, 0};
    for (std::size_t i = 0; i < 12; ++i)
        CHECK_NEAR(side.worldFromCamera.at(0)[i], expected[i], 1e-15);
    CHECK_NEAR(side.sensorHeightMm / 2 / side.lensMm, std::tan(kPi / 8), 1e-15); // 45 degrees
    const CameraDesc lens =
        scene(R"({"camera": {"position": [0, 0, 1], "lens": 30, "sensor": [36, 20],
               "aperture_radius": 0.5, "keys": [{}, {"position": [0, 0, 2]}]}})")
            .cameras.at(0);
    CHECK(lens.lensMm == 30 && lens.sensorHeightMm == 20 && lens.apertureRadius == 0.5);
    CHECK_EQUAL(lens.worldFromCamera.at(0)[11], 1.0);
    CHECK_EQUAL(lens.worldFromCamera.at(1)[11], 2.0);
}

// diffuse / pi * E * cos and specular / pi * E * (N.H)^e are to be diffuse * colour * power * cos
// and specular * colour * power * (N.H)^e.
TEST(read_json_units_of_light) {
    const std::string light_ = R"("colour": [1, 0.5, 0], "power": 2)";
    checkColor(light("", R"("type": "point",)" + light_).color, {2 * kPi, kPi, 0});
    checkColor(light("", R"("type": "spot",)" + light_).color, {2 * kPi, kPi, 0});
    checkColor(light("", R"("type": "sun",)" + light_).color, {2 * kPi, kPi, 0});
    // The surface of a lamp looks as bright as it says.
    checkColor(light("", R"("type": "rectangle",)" + light_).color, {2, 1, 0});
    checkColor(light("", R"("type": "sphere", "radius": 1,)" + light_).color, {2, 1, 0});
    const SceneDesc desc = scene(R"({"materials": [
        {"name": "a", "specular": [1, 0.5, 0], "shininess": 8},
        {"name": "b", "specular": [1, 0.5, 0], "specular_model": "phong"},
        {"name": "c", "specular": [1, 0.5, 0], "specular_model": "ashikhmin"}]})");
    checkColor(desc.materials.at(0).specular, {1 / kPi, 0.5 / kPi, 0});
    checkColor(desc.materials.at(1).specular, {1 / kPi, 0.5 / kPi, 0});
    checkColor(desc.materials.at(2).specular, {1, 0.5, 0});
    CHECK_EQUAL(desc.materials[0].exponent, 8.0);
    CHECK_EQUAL(desc.materials[1].exponent, 0.0); // the default of 'shininess'
}

TEST(read_json_fall_off_of_the_dialects) {
    const std::string point = R"("type": "point", "position": [1, 2, 3])";
    const LightDesc numbered = light(R"("AA": {"samples": 1},)", point);
    CHECK((numbered.attenuation == Vec3d{0, 0, 1}));
    checkPoint(Transform::fromRows(numbered.worldFromLight).translation(), {1, 2, 3}, 0);
    CHECK((light(R"("AA_samples": 1,)", point).attenuation == Vec3d{1, 0, 0}));
    CHECK((light(R"("camera": {"position": [0, 0, 1], "fovy": 45},)", point).attenuation ==
           Vec3d{0, 0, 1}));
    CHECK((light("", point).attenuation == Vec3d{1, 0, 0}));
    CHECK((light("", point + R"(, "attenuation": [3, 2, 1])").attenuation == Vec3d{3, 2, 1}));
}

TEST(read_json_directional_light) {
    // `direction` points to the light: it shines the other way. Longer ones are normalised.
    const std::string body = R"("type": "directional", "direction": [0, 3, 4], "power": 2)";
    const LightDesc named = light("", body);
    CHECK(named.kind == LightDesc::Kind::Sun);
    checkPoint(shines(named), {0, -0.6, -0.8});
    checkColor(named.color, {2 * kPi, 2 * kPi, 2 * kPi});
    // In the first dialect its power is 1, whatever the file says.
    checkColor(light(R"("AA": {"samples": 1},)", body).color, {kPi, kPi, kPi});
    checkPoint(shines(light("", R"("type": "directional", "direction": [0, 1, 0])")), {0, -1, 0});
}

TEST(read_json_aimed_lights) {
    checkPoint(shines(light("", R"("type": "spot", "direction": [0, -2, 0])")), {0, -1, 0});
    checkPoint(shines(light("", R"("type": "spot")")), {0, -1, 0});
    const LightDesc spot = light(
        "", R"("type": "spot", "position": [1, 5, 0], "lookAt": [1, 1, 3], "cone_angle": 30)");
    checkPoint(shines(spot), {0, -0.8, 0.6});
    checkPoint(Transform::fromRows(spot.worldFromLight).translation(), {1, 5, 0});
    CHECK_EQUAL(spot.coneAngleDeg, 30.0);
    // A quarter turn about x takes -Z to +Y.
    checkPoint(shines(light("", R"("type": "rectangle", "rotation": [90, 0, 0])")), {0, 1, 0});
    const LightDesc panel = light(
        "", R"("type": "rectangle", "direction": [0, -1, 0], "up": [1, 0, 0], "size": [2, 3])");
    checkPoint(Transform::fromRows(panel.worldFromLight).vector({0, 1, 0}), {1, 0, 0});
    CHECK((panel.size == Vec2d{2, 3}));
}

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

// T * Rx * Ry * Rz * S, checked by a point that each factor moves: S doubles x, Rz takes x to y, Ry
// leaves y, Rx takes y to z.
TEST(read_json_order_of_transforms) {
    const ObjectDesc sphere = objects(R"({"type": "sphere", "position": [10, 0, 0],
        "rotation": [90, 90, 90], "scale": [2, 3, 4]})")
                                  .at(0);
    checkPoint(worldPoint(sphere, {1, 0, 0}), {10, 0, 2});
    checkPoint(worldPoint(sphere, {0, 1, 0}), {10, -3, 0}); // y to -x, -x to z, z to -y
    checkPoint(worldPoint(sphere, {0, 0, 1}), {14, 0, 0});  // z, z to x, x
}

TEST(read_json_nested_nodes) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"name": "top", "type": "node", "position": [0, 0, 5], "rotation": [0, 90, 0], "scale": 2,
         "children": [
            {"name": "mid", "type": "node", "position": [1, 0, 0], "rotation": [0, 0, 90],
             "scale": [1, 1, 1], "children": [
                {"name": "ball", "type": "sphere", "position": [0, 2, 0], "radius": 3}]},
            {"name": "ball", "type": "sphere"}]})");
    CHECK_EQUAL(list.size(), std::size_t{2});
    CHECK_EQUAL(list.at(0).name, "top/mid/ball");
    CHECK_EQUAL(list.at(1).name, "top/ball");
    // (0,2,0): Rz90 to (-2,0,0), moved to (-1,0,0), doubled to (-2,0,0), Ry90 takes x to -z.
    checkPoint(worldPoint(list[0], {}), {0, 0, 7});
    checkPoint(worldPoint(list[0], {1, 0, 0}), {0, 2, 7}); // x to y, doubled
    CHECK_EQUAL(list[0].radius, 3.0);
}

// A node with 'ref' takes the children of an earlier node: its own transform replaces that one's in
// the first dialect, and multiplies in the others.
TEST(read_json_references) {
    const std::string nodes = R"("objects": [
        {"name": "one", "type": "node", "position": [1, 0, 0], "ref": "", "children": [
            {"name": "ball", "type": "sphere", "position": [0, 1, 0]}]},
        {"name": "two", "type": "node", "position": [0, 0, 7], "ref": "one", "materials": []}]})";
    const SceneDesc replaced = scene(R"({"AA": {"samples": 1},)" + nodes);
    CHECK_EQUAL(replaced.objects.at(1).name, "two/ball");
    checkPoint(worldPoint(replaced.objects[0], {}), {1, 1, 0});
    checkPoint(worldPoint(replaced.objects[1], {}), {0, 1, 7});
    const SceneDesc multiplied = scene(R"({"AA_samples": 1,)" + nodes);
    CHECK_EQUAL(multiplied.objects.at(1).name, "two/one/ball");
    checkPoint(worldPoint(multiplied.objects[1], {}), {1, 1, 7});
}

TEST(read_json_instances) {
    const SceneDesc desc = scene(R"({"objects": [
        {"name": "ball", "type": "sphere", "position": [1, 0, 0], "radius": 2},
        {"name": "pair", "type": "node", "children": [
            {"name": "l", "type": "instance", "ref": "ball", "position": [0, 5, 0]},
            {"name": "r", "type": "instance", "ref": "ball", "scale": [-2, 2, 2]}]},
        {"type": "instance", "ref": "pair", "rotation": [0, 0, 90]},
        {"type": "instance", "ref": "r", "position": [0, 0, 1]}]})");
    const std::vector<ObjectDesc>& list = desc.objects;
    CHECK_EQUAL(list.size(), std::size_t{6});
    checkPoint(worldPoint(list.at(1), {}), {1, 5, 0});
    checkPoint(worldPoint(list.at(2), {}), {-2, 0, 0});
    CHECK_EQUAL(list.at(3).name, "instance1/pair/l/ball");
    checkPoint(worldPoint(list[3], {}), {-5, 1, 0});
    checkPoint(worldPoint(list.at(5), {}), {-2, 0, 1}); // without what is above 'r'
    CHECK_THROWS(scene(R"({"objects": [{"name": "a", "type": "node", "children": [
                       {"type": "instance", "ref": "a"}]}]})"),
                 "no earlier object is named 'a'");
}

TEST(read_json_materials_come_from_above) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"type": "node", "materials": [1], "children": [
            {"type": "sphere"}, {"type": "sphere", "materials": null},
            {"type": "sphere", "materials": [0]},
            {"type": "node", "materials": [], "children": [{"type": "sphere", "materials": []}]}]},
        {"type": "sphere"})");
    const std::vector<std::vector<Handle>> expected = {{1}, {1}, {0}, {1}, {}};
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK_INFO(list.at(i).materials == expected[i], "object " << i);
    // Of a reference with materials, these; of one without, those of the node that it names.
    const std::vector<ObjectDesc> refs = objects(R"(
        {"name": "n", "type": "node", "materials": [0], "children": [{"type": "sphere"}]},
        {"type": "node", "ref": "n"}, {"type": "node", "ref": "n", "materials": [1]})");
    CHECK((refs.at(1).materials == std::vector<Handle>{0}));
    CHECK((refs.at(2).materials == std::vector<Handle>{1}));
}

TEST(read_json_unknown_materials_are_left_out) {
    const Reading reading = readObjects(R"({"type": "plane", "materials": [7, "bb", "b", 0]})");
    CHECK((reading.desc.objects.at(0).materials == std::vector<Handle>{1, 0}));
    CHECK(hasWarning(reading, "warning: no material has the ID 7; it is left out"));
    CHECK(hasWarning(reading, "unknown material 'bb'; did you mean 'b'?"));
    const Reading many = readObjects(R"({"type": "sphere", "materials": [0, 1]})");
    CHECK((many.desc.objects.at(0).materials == std::vector<Handle>{0}));
    CHECK(hasWarning(many, "has 2 materials; only the first counts"));
    // Of equal IDs and names the first counts.
    const Reading twice = read(R"({"materials": [{"name": "m", "ID": 3}, {"name": "m", "ID": 3}],
        "objects": [{"type": "sphere", "materials": [3]}, {"type": "sphere", "material": "m"}]})");
    CHECK_EQUAL(twice.desc.materials.at(1).name, "m.2");
    CHECK(twice.desc.objects.at(0).materials == twice.desc.objects.at(1).materials);
    CHECK_EQUAL(twice.warnings.size(), std::size_t{2});
}

TEST(read_json_names_are_unique) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"name": "x", "type": "sphere"}, {"name": "x", "type": "sphere"}, {"type": "sphere"},
        {"name": "x.2", "type": "sphere"}, {"type": "disk", "name": ""}, {"type": "sphere"},
        {"name": "n", "type": "node", "children": [{"name": "x", "type": "sphere"}]})");
    const std::vector<std::string> expected = {"x",     "x.2",     "sphere1", "x.2.2",
                                               "disk1", "sphere2", "n/x"};
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK_EQUAL(list.at(i).name, expected[i]);
}

TEST(read_json_motion) {
    const std::vector<ObjectDesc> list = objects(R"(
        {"type": "node", "position": [0, 1, 0], "keys": [{}, {"position": [0, 2, 0]}], "children": [
            {"type": "sphere", "position": [1, 0, 0], "scale": 2},
            {"type": "sphere", "keys": [{"position": [5, 0, 0]}, {"scale": 3}]}]})");
    const auto at = [&](std::size_t object, std::size_t key) {
        return Transform::fromRows(list.at(object).worldFromObject.at(key)).point({1, 0, 0});
    };
    checkPoint(at(0, 0), {3, 1, 0});
    checkPoint(at(0, 1), {3, 2, 0});
    checkPoint(at(1, 0), {6, 1, 0});
    checkPoint(at(1, 1), {3, 2, 0});
    CHECK_THROWS(objects(R"({"type": "node", "keys": [{}, {}], "children": [
                          {"name": "s", "type": "sphere", "keys": [{}, {}, {}]}]})"),
                 "'s' has 3 keys, and what is above it 2");
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

// Copies of copies: the sum is known before any is made.
TEST(read_json_copies_are_bounded) {
    const auto tower = [](int levels, std::string_view dialect) {
        std::string text =
            cat("{", dialect,
                R"("objects": [{"name": "n0", "type": "node", "children": [{"type": "sphere"}]})");
        for (int i = 1; i <= levels; ++i) {
            const std::string ref = cat(R"({"type": "instance", "ref": "n)", i - 1, "\"}");
            text += cat(",\n{\"name\": \"n", i, R"(", "type": "node", "children": [)", ref, ",",
                        ref, "]}");
        }
        return text + "]}";
    };
    CHECK_EQUAL(scene(tower(3, "")).objects.size(), std::size_t{1 + 2 + 4 + 8});
    CHECK_THROWS(scene(tower(64, "")), "the scene has more than 1048576 objects");
    // One inside the other, so deep that following them would end the stack.
    std::string chain = R"({"objects": [{"name": "n0", "type": "sphere"})";
    for (int i = 1; i <= 3000; ++i)
        chain += cat(R"(,{"name": "n)", i, R"(", "type": "instance", "ref": "n)", i - 1, "\"}");
    CHECK_THROWS(scene(chain + "]}"), "nodes and instances are nested more than 1000 deep here");
}

TEST(read_json_world_and_textures) {
    const SceneDesc desc = scene(R"({"ambient": [0.2, 0.3, 0.4],
        "textures": [{"name": "sky", "file": "sky.pfm", "space": "linear", "scale": [2, 3]}],
        "materials": [{"name": "m", "diffuse_texture": "sky", "mirror": [0.5, 0.5, 0.5],
                       "fresnel": "schlick", "ior": 1.33}],
        "world": {"environment": "sky", "environment_rotation": 90}})");
    CHECK(desc.textures.at(0).space == TextureDesc::Space::Linear);
    CHECK((desc.textures[0].scale == Vec2d{2, 3}));
    CHECK(desc.world.environment == 0 && desc.world.rotationDeg == 90);
    checkColor(desc.world.background, {1, 1, 1}); // the picture as it is
    checkColor(desc.world.ambient, {0.2, 0.3, 0.4});
    CHECK(desc.materials.at(0).diffuseTexture == 0 && desc.materials[0].ior == 1.33);
    CHECK(desc.materials[0].fresnel == MaterialDesc::Fresnel::Schlick);
    checkColor(scene(R"({"world": {"ambient": [0, 0, 1]}})").world.ambient, {0, 0, 1});
}

TEST(read_json_lenient) {
    const std::string text = R"({"AA_sample": 4, "objects": [
        {"type": "torus", "name": "t"}, {"type": "sphere", "radious": 2}],
        "lights": [{"type": "laser"}]})";
    const Reading reading = read(text, true);
    CHECK_EQUAL(reading.desc.objects.size(), std::size_t{1});
    CHECK(hasWarning(reading, "unknown type of object 'torus'; known: sphere, box, plane"));
    CHECK(hasWarning(reading, "unknown key 'radious' of the sphere; did you mean 'radius'?"));
    CHECK(hasWarning(reading, "unknown key 'AA_sample' of the scene; did you mean 'AA_samples'?"));
    CHECK(hasWarning(reading, "unknown type of light 'laser'"));
    const std::string message = check::thrown([&] { read(text); });
    for (const std::string place : {"t.json:1:2:", "t.json:2:18:", "t.json:2:60:", "t.json:3:29:"})
        CHECK_INFO(message.find(place + " error: unknown") != std::string::npos, message);
}

TEST(read_json_places_of_blocks) {
    const std::string text = R"({"camera": {"position": [0, 0, 1]}, "world": {}, "settings": {},
        "textures": [{"name": "t", "file": "f.ppm"}], "materials": [{"name": "m"}],
        "lights": [{"type": "point"}], "objects": [{"type": "mesh", "filepath": "f.obj"}]})";
    const SceneDesc desc = scene(text);
    const auto checkPlace = [&](SourceLoc loc, const std::string& words) {
        CHECK_INFO(text.compare(loc.offset, words.size(), words) == 0, words << " " << loc.offset);
    };
    checkPlace(desc.cameras.at(0).loc, "{\"position\"");
    checkPlace(desc.world.loc, "{}, \"settings\"");
    checkPlace(desc.settings.loc, "{},\n");
    checkPlace(desc.textures.at(0).loc, "{\"name\": \"t\"");
    checkPlace(desc.textures[0].fileLoc, "\"f.ppm\"");
    checkPlace(desc.materials.at(0).loc, "{\"name\": \"m\"");
    checkPlace(desc.lights.at(0).loc, "{\"type\": \"point\"");
    checkPlace(desc.objects.at(0).loc, "{\"type\": \"mesh\"");
    checkPlace(desc.meshes.at(0).fileLoc, "\"f.obj\"");
}

// Each property of the native tables is a key: a number too large for any of them is refused in
// words that show that the key is known, and a wrong key is not.
TEST(read_json_every_native_property_is_a_key) {
    std::size_t count = 0;
    const auto check = [&](std::string_view keyword, const std::string& before,
                           const std::string& after) {
        ++count;
        const std::string message = check::thrown(
            [&] { read(cat("{", before, "\"", keyword, "\": {\"x\": 1}", after, "}")); });
        CHECK_INFO(message.find("error: expected") != std::string::npos &&
                       message.find("unknown key") == std::string::npos,
                   keyword << ": " << message);
    };
    for (const auto& row : kSettingsProperties) check(row.keyword, "\"settings\": {", "}");
    for (const auto& row : kWorldProperties) check(row.keyword, "\"world\": {", "}");
    for (const auto& row : kCameraProperties)
        check(row.keyword, "\"camera\": {\"position\": [1, 1, 1],", "}");
    for (const auto& row : kTextureProperties)
        check(row.keyword, "\"textures\": [{\"name\": \"t\",", "}]");
    for (const auto& row : kMaterialProperties) check(row.keyword, "\"materials\": [{", "}]");
    for (const auto& row : kLightProperties)
        if (row.keyword != "type")
            check(row.keyword, "\"lights\": [{\"type\": \"spot\", \"name\": \"s\",", "}]");
    for (const std::string type : {"sphere", "plane", "quad", "disk", "cylinder", "cone", "cube"}) {
        const ObjectDesc::Kind kind =
            scene(cat(R"({"objects": [{"type": ")", type, "\"}]}")).objects.at(0).kind;
        for (const auto& row : kObjectProperties)
            if (row.kinds & only(kind))
                check(row.keyword, cat(R"("objects": [{"type": ")", type, "\", "), "}]");
    }
    CHECK_INFO(count > 90, count);
}

// The example scenes are sound, and say nothing but what they are meant to show.
TEST(read_json_examples) {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator("ASCII")) {
        if (entry.path().extension() != ".json") continue;
        ++count;
        const SourceFile source{entry.path().string(), contentOf(entry.path())};
        Diagnostics diagnostics;
        const std::string message = check::thrown([&] {
            const SceneDesc desc = readJson(source, {{}, diagnostics});
            if (desc.meshes.empty()) validate(desc, source, diagnostics);
        });
        CHECK_INFO(message.empty() && diagnostics.warnings.empty(),
                   message << join(diagnostics.warnings));
    }
    CHECK_INFO(count >= 11, "scenes: " << count);
}

TEST(read_json_keys_of_copies_are_bounded) {
    const auto scenery = [](int copies) {
        std::string keys = "{}";
        for (int i = 1; i < 200; ++i) keys += ",{}";
        std::string text = cat(R"({"objects": [{"name": "n", "type": "node", "keys": [)", keys,
                               R"(], "children": [{"type": "sphere"}]})");
        for (int i = 0; i < copies; ++i) text += R"(,{"type": "instance", "ref": "n"})";
        return text + "]}";
    };
    CHECK_EQUAL(scene(scenery(9)).objects.at(9).worldFromObject.size(), std::size_t{200});
    CHECK_THROWS(scene(scenery(11000)), "the keys and materials of all objects are more than");
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
