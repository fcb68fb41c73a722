// The NFF reader: what it makes of a whole scene, its view, lights and fills, in numbers worked out
// by hand. Shapes are in test_nff_shapes.cpp; what it refuses is in tests/bad/nff
// (test_bad_scenes.cpp).
#include "read/nff/read_nff.h"

#include "base/math.h"
#include "base/transform.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "read/txt/read_txt.h"
#include "unit/damage.h"
#include "unit/nff_kit.h"

#include <cmath>

namespace test_read_nff {

using nff_kit::checkPoint;
using nff_kit::kView;
using nff_kit::Read;
using nff_kit::readBody;
using nff_kit::readWhole;

namespace {

std::string everything() { return damage::contentOf("tests/scenes/nff/everything.nff"); }
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}
void checkRgb(Rgbd color, Rgbd expected) {
    CHECK_NEAR(color.r, expected.r, 1e-15);
    CHECK_NEAR(color.g, expected.g, 1e-15);
    CHECK_NEAR(color.b, expected.b, 1e-15);
}

} // namespace

TEST(read_nff_everything) {
    const Read read = readWhole(everything());
    CHECK_INFO(read.warnings.empty(), join(read.warnings));
    const SceneDesc& desc = read.desc;
    CHECK_EQUAL(desc.settings.width, 64);
    CHECK_EQUAL(desc.settings.height, 48);
    CHECK_EQUAL(desc.settings.maxDepth, 4);
    CHECK_EQUAL(desc.settings.cutoff, 0.0);
    CHECK((desc.world.background == Rgbd{0.078, 0.361, 0.753}));
    std::vector<std::string> objects, meshes, materials, lights;
    for (const auto& object : desc.objects) objects.push_back(object.name);
    for (const auto& mesh : desc.meshes) meshes.push_back(mesh.name);
    for (const auto& material : desc.materials) materials.push_back(material.name);
    for (const auto& light : desc.lights) lights.push_back(light.name);
    CHECK_EQUAL(join(objects), "polygons1, sphere1, sphere2, cone1, cone2, cone3, sphere3, "
                               "polygons2, patches1, polygons3");
    CHECK_EQUAL(join(meshes), "polygons1, polygons2, patches1, polygons3");
    CHECK_EQUAL(join(materials), "fill1, fill2, fill3, fill4");
    CHECK_EQUAL(join(lights), "light1, light2");
    CHECK_EQUAL(desc.cameras.at(0).name, "view");
    // The last fill equals the second.
    CHECK((desc.objects.at(9).materials == std::vector<Handle>{1}));
    CHECK((desc.objects.at(1).materials == std::vector<Handle>{1}));
    Diagnostics diagnostics;
    validate(desc, {"everything.nff", everything()}, diagnostics);
    CHECK_INFO(diagnostics.warnings.empty(), join(diagnostics.warnings));
    CHECK(readTxt({"again.txt", writeTxt(desc)}) == desc);
}

// Line ends mean nothing, comments may stand anywhere.
TEST(read_nff_by_word) {
    const std::string text = everything();
    const SceneDesc desc = readWhole(text).desc;
    std::string bare;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '#') i = text.find('\n', i);
        bare += text[i];
    }
    CHECK(readWhole(bare).desc == desc);
    CHECK(readWhole(replaced(bare, "\n", " ")).desc == desc);
    CHECK(readWhole(replaced(bare, " ", "\n")).desc == desc);
    CHECK(readWhole(replaced(bare, " ", "#5 s\n")).desc == desc);
    CHECK(readWhole(replaced(text, "\n", "\r\n")).desc == desc);
    CHECK(readWhole(replaced(text, "\n", "\r")).desc == desc);
    CHECK(readWhole(replaced(text, " ", "\t")).desc == desc);
    CHECK(readWhole("\xef\xbb\xbf" + text).desc == desc);
    CHECK(readWhole(text.substr(0, text.size() - 1)).desc == desc);
}

TEST(read_nff_view) {
    const auto cameraOf = [](const std::string& view, bool toEdges) {
        ReadOptions options;
        options.nffAngleToEdges = toEdges;
        return readWhole("v " + view, options).desc.cameras.at(0);
    };
    const std::string place = "from 1 2 3 at 1 7 3 up 0 0.5 2 hither 1 angle 90 ";
    CameraDesc camera = cameraOf(place + "resolution 30 11", false);
    // Looks along +y with z up: x stays right.
    const Transform world = Transform::fromRows(camera.worldFromCamera.at(0));
    checkPoint(world.point({0, 0, 0}), {1, 2, 3}, 0);
    checkPoint(world.vector({0, 0, -1}), {0, 1, 0}, 0);
    checkPoint(world.vector({1, 0, 0}), {1, 0, 0}, 0);
    checkPoint(world.vector({0, 1, 0}), {0, 0, 1}, 0);
    CHECK(camera.sensorFit == CameraDesc::SensorFit::Vertical);
    // Ten steps from the first to the last of eleven rows are 2 tan 45: eleven are 2.2.
    CHECK_NEAR(camera.sensorHeightMm / camera.lensMm, 2.2, 1e-15);
    CHECK_EQUAL(camera.clipStart, 0.0);
    camera = cameraOf(place + "resolution 30 11", true);
    CHECK_NEAR(camera.sensorHeightMm / camera.lensMm, 2.0, 1e-15);
    // One row has no step: its edges take the angle.
    camera = cameraOf(place + "resolution 30 1", false);
    CHECK_NEAR(camera.sensorHeightMm / camera.lensMm, 2.0, 1e-15);
    camera = cameraOf("resolution 8 5 up 0 0 1 angle 60 at 0 0 0 from 1 0 0", false);
    CHECK_NEAR(camera.sensorHeightMm / camera.lensMm, 2 / std::sqrt(3.0) * 5 / 4, 1e-15);
}

// sqrt(n)/(2n) for n lights, and pi times that, as our diffuse term divides by pi.
TEST(read_nff_lights) {
    const SceneDesc one = readBody("l 1 2 3");
    CHECK_EQUAL(one.world.ambient.g, 0.5);
    CHECK_NEAR(one.lights.at(0).color.r, kPi / 2, 1e-15);
    CHECK((one.lights[0].attenuation == Vec3d{0, 0, 1}));
    CHECK(one.lights[0].kind == LightDesc::Kind::Point && one.lights[0].radius == 0);
    checkPoint(Transform::fromRows(one.lights[0].worldFromLight).translation(), {1, 2, 3}, 0);
    const SceneDesc three = readBody("l 1 2 3 0.5 0.25 2 l 4 5 6 l 7 8 9\nb 0 0 1");
    checkRgb(three.world.ambient, {std::sqrt(3.0) / 6, std::sqrt(3.0) / 6, std::sqrt(3.0) / 6});
    checkRgb(three.lights.at(0).color, {kPi / 2, kPi / 4, 2 * kPi});
    CHECK_NEAR(three.lights.at(2).color.b, kPi * std::sqrt(3.0) / 6, 1e-15);
    checkPoint(Transform::fromRows(three.lights[2].worldFromLight).translation(), {7, 8, 9}, 0);
    CHECK((readBody("").world.ambient == Rgbd{0, 0, 0}));
}

TEST(read_nff_fill) {
    const SceneDesc desc = readBody("f 1 0.5 0 0.6 0.3 12.5 0.2 1.33 s 0 0 0 1\n"
                                    "f 1 1 1 0.5 0 100000 0 0 s 3 0 0 1\n"
                                    "f 0 0 0 0 0 0 0 -1 # nothing uses this one\n"
                                    "f 1 0.5 0 0.6 0.3 12.5 0.2 1.33 s 6 0 0 1\n");
    CHECK_EQUAL(desc.materials.size(), std::size_t{2});
    const MaterialDesc& glass = desc.materials[0];
    checkRgb(glass.diffuse, {0.6, 0.3, 0});
    checkRgb(glass.specular, {0.3 / kPi, 0.3 / kPi, 0.3 / kPi});
    CHECK(glass.specularModel == MaterialDesc::SpecularModel::Phong);
    CHECK_EQUAL(glass.exponent, 12.5);
    checkRgb(glass.mirror, {0.3, 0.3, 0.3});
    checkRgb(glass.transmission, {0.2, 0.2, 0.2});
    CHECK_EQUAL(glass.ior, 1.33);
    CHECK(glass.fresnel == MaterialDesc::Fresnel::None);
    const MaterialDesc& chalk = desc.materials[1];
    CHECK((chalk.specular == Rgbd{} && chalk.mirror == Rgbd{} && chalk.transmission == Rgbd{}));
    CHECK_EQUAL(chalk.exponent, 100000.0);
    CHECK_EQUAL(chalk.ior, 1.0);
    CHECK((desc.objects.at(2).materials == std::vector<Handle>{0}));
    // What transmits reflects rays too, which count and are not seen.
    const MaterialDesc clear = readBody("f 1 1 1 0.2 0 1 0.8 1.1 s 0 0 0 1").materials.at(0);
    CHECK(clear.mirror.r > 0 && clear.mirror.r < 1e-9 && clear.mirror.r == clear.mirror.b);
    CHECK((clear.specular == Rgbd{}));
}

TEST(read_nff_without_fill) {
    const Read read = readWhole(kView + "s 0 0 0 1\np 3 0 0 0 1 0 0 0 1 0\ns 0 0 0 2\n");
    CHECK_EQUAL(read.warnings.size(), std::size_t{1});
    CHECK_INFO(read.warnings.at(0).starts_with("t.nff:2:1: warning: there is no fill"),
               read.warnings[0]);
    CHECK(read.desc.objects.size() == 3 && read.desc.materials.empty());
}

// Fills that come again, written otherwise too, before and behind what they colour.
TEST(read_nff_equal_fills_are_one_material) {
    const std::string text = "# s 1 1 1 1\nb 0.1 0.2 0.3\nl 1 2 3\n" + kView +
                             "f 1 0.5 0.25 0.7 0.2 50 0 0\n"
                             "s 0 0 0 1\ns 1 0 0 -1\n"
                             "p 3\n0 0 0\n1 0 0\n0 1 0\n"
                             "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n"
                             "  f 0.25 1 1 1 0 9 0.5 1.5 # glass\r\n"
                             "p 4\n0 0 1\n1 0 1\n#s\n1 1 1 # f 1 1 1\n0 1 1\n"
                             "c 0 0 0 1\n0 0 1 0.5\nc 0 0 0 -1 0 0 2 -1\n"
                             "s 3 0 0 -2\n"
                             "f 1 .5 0.250 0.7 2e-1 50 -0 0\n"
                             "p 3\n0 0 2\n1 0 2\n0 1 2\ns 2 2 2 0\n"
                             "pp 3\n0 0 3 0 0 1\n1 0 3 0 0 1\n0 1 3 0 0 1\n"
                             "p 3\n0 0 2\n1 0 2\n2 0 2\n"
                             "f 0.5 0.5 0.5 1 0 0 0 0\n"
                             "pp 3\n0 0 5 0 0 1\n1 0 5 0 0 1\n0 1 5 0 0 1\n"
                             "c 0 0 0 0 0 0 0 0\ns 9 9 9 1\nf 1 1 1 1 0 0 0 0\n";
    const Read read = readWhole(text);
    CHECK_EQUAL(read.warnings.size(), std::size_t{3});
    const SceneDesc& desc = read.desc;
    CHECK_EQUAL(desc.materials.size(), std::size_t{3});
    CHECK_EQUAL(desc.objects.back().materials.at(0), 2);
    std::vector<std::string> meshes, objects;
    for (const auto& mesh : desc.meshes) meshes.push_back(cat(mesh.name, " ", mesh.points.size()));
    for (const auto& object : desc.objects) objects.push_back(object.name);
    CHECK_EQUAL(join(meshes), "polygons1 6, patches1 6, polygons2 4, patches2 3");
    CHECK_EQUAL(join(objects), "sphere1, sphere2, polygons1, patches1, polygons2, cone1, cone2, "
                               "sphere3, patches2, sphere4");
}

// Several errors are told together.
TEST(read_nff_collects_errors) {
    const std::string message = check::thrown([] {
        readWhole("v from 0 0 0 at 0 0 0 up 0 0 1 angle 190 resolution 1.5 70000\n"
                  "l 1 2 3 -1 0 0\nc 0 0 0 1 0 0 1 -1\ns 0 0 0 1e70\nb 1 1 2 3\n");
    });
    for (const char* words :
         {"t.nff:1:1: error: the view looks 'at' where it is 'from'",
          "t.nff:1:38: error: 'angle' must be > 0 and at most 179.999, got 190",
          "t.nff:1:53: error: expected a whole number, got '1.5'",
          "t.nff:1:57: error: number 2 of 'resolution' must be from 1 to 65535, got 70000",
          "t.nff:2:9: error: number 4 of 'l' must be >= 0, got -1",
          "t.nff:3:1: error: the radii of 'c' have different signs: 1 and -1",
          "t.nff:4:9: error: number 4 of 's' must be at most 1e+60, got 1e+70",
          "t.nff:5:9: error: expected an entity, got '3'; the 'b' at line 5 has all its numbers"})
        CHECK_INFO(message.find(words) != std::string::npos, words << "; not in\n" << message);
}

namespace {

// What is accepted must also survive being written in the native format and read again.
void readSound(const std::string& text) {
    const SourceFile source{"damaged.nff", text};
    Diagnostics diagnostics;
    const SceneDesc desc = readNff(source, {{}, diagnostics});
    validate(desc, source, diagnostics);
    CHECK_INFO(readTxt({"again.txt", writeTxt(desc)}) == desc, "read from:\n" << text);
}

} // namespace

TEST(read_nff_cut_off_at_every_byte) {
    const std::string whole = everything();
    readSound(whole);
    std::size_t read = 0, refused = 0;
    for (std::size_t size = 0; size < whole.size(); ++size)
        ++(damage::isRead([&] { readSound(whole.substr(0, size)); }) ? read : refused);
    // A cut is seen unless it falls between two entities or into the last digits of a number.
    CHECK_INFO(refused > whole.size() / 2 && read > 50, "read " << read << ", refused " << refused);
}

TEST(read_nff_random_damage) {
    const std::string whole = everything();
    const std::vector<std::string> pieces = {
        "#",      "\n", "\r",         " ",      "-",           "nan",        "1e999",
        "0",      "p",  "pp 3",       "pp",     "v",           "c",          "f",
        "p 4000", "s",  "4294967297", "1e-400", "\xff",        ".",          "e5",
        "l",      "b",  "-1e60",      "inf",    "1e308 1e308", "p 99999999", std::string(1, '\0')};
    const auto [read, refused] = damage::inflict(
        whole, pieces, 4000, [](const std::string& text, std::uint32_t) { readSound(text); });
    // Both must happen, or the test tests nothing.
    CHECK_INFO(read > 500 && refused > 1000, "read " << read << ", refused " << refused);
}

} // namespace test_read_nff
