// --lenient: what is wrong in a scene in JSON is a warning, and there is a scene that can be
// rendered with what is left. Without it the same is an error.
#include "base/text.h"
#include "check.h"
#include "read/load.h"
#include "temporary_folder.h"

#include <string>
#include <utility>
#include <vector>

namespace test_json_lenient {

namespace {

struct Row {
    std::string text;    // of the object, material ...
    std::string warning; // words of it
};

class Scenes {
public:
    Scenes() {
        folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        folder_.write("broken.obj", "v 0 0 0\nv 1 0\nf 1 2 3\n");
    }
    struct Reading {
        LoadedScene scene;
        std::string warnings, error;
    };
    Reading read(const std::string& text, bool lenient) const {
        const std::string file = folder_.write("scene.json", text);
        Reading reading;
        Diagnostics diagnostics;
        ReadOptions options;
        options.lenient = lenient;
        reading.error = check::thrown([&] { reading.scene = load(file, diagnostics, options); });
        reading.warnings = join(diagnostics.warnings, "\n");
        return reading;
    }

private:
    TemporaryFolder folder_{"lenient"};
};

const std::string kCamera = R"("camera": {"position": [0, 0, 6], "fov": 40})";
const std::string kBall = R"({"name": "ball", "type": "sphere"})";

// The ball is there, whatever else is; text() makes a scene of a row.
template <class Text>
void checkRows(const Scenes& scenes, const std::vector<Row>& rows, const Text& text) {
    for (const Row& row : rows) {
        const auto strict = scenes.read(text(row.text), false);
        CHECK_INFO(strict.error.find(row.warning) != std::string::npos,
                   row.text << " without --lenient: " << strict.error << strict.warnings);
        const auto lenient = scenes.read(text(row.text), true);
        CHECK_INFO(lenient.error.empty(), row.text << ": " << lenient.error);
        CHECK_INFO(lenient.warnings.find("warning: ") != std::string::npos &&
                       lenient.warnings.find(row.warning) != std::string::npos &&
                       lenient.warnings.find("error: ") == std::string::npos,
                   row.text << " says " << lenient.warnings);
        const SceneDesc& desc = lenient.scene.desc;
        CHECK_INFO(!desc.cameras.empty() && !desc.objects.empty() &&
                       desc.objects.front().name == "ball",
                   row.text);
    }
}

} // namespace

TEST(json_lenient_objects) {
    const Scenes scenes;
    const std::vector<Row> rows = {
        {R"("cube")", "expected an object in 'objects', got the text 'cube'"},
        {R"({})", "an object needs a 'type'"},
        {R"({"type": 3})", "expected a text for 'type', got the number 3"},
        {R"({"type": "gearwheel"})", "unknown type of object 'gearwheel'"},
        {R"({"type": "sphere", "radius": "big"})", "expected a number for 'radius'"},
        {R"({"type": "sphere", "radius": -1})", "'radius' must be > 0, got -1"},
        {R"({"type": "sphere", "position": 5})", "expected an array of 3 numbers for 'position'"},
        {R"({"type": "sphere", "scale": 0})", "its transform flattens it: a scale is 0"},
        {R"({"type": "sphere", "keys": 5})", "expected an array of 1 to 256 objects for 'keys'"},
        {R"({"type": "sphere", "keys": [{}, {"scale": [-1, 1, 1]}]})", "one of its keys mirrors"},
        {R"({"type": "sphere", "sides": "left"})", "unknown sides 'left'"},
        {R"({"type": "sphere", "materials": 3.5})", "expected an array for 'materials'"},
        {R"({"type": "sphere", "materials": [[]]})", "expected the ID or the name of a material"},
        {R"({"type": "sphere", "colour": 1})", "unknown key 'colour'"},
        {R"({"type": "cone", "radius": 0, "top_radius": 0})", "are both 0"},
        {R"({"type": "cylinder", "caps": "no"})", "expected true or false for 'caps'"},
        {R"({"type": "plane", "normal": [0, 0, 0]})", "'normal' of a plane is 0 0 0"},
        {R"({"type": "box", "min": [1, 1, 1], "max": [0, 0, 0]})", "a box has a 'max' above"},
        {R"({"type": "box", "size": [1, 0, 1]})", "'size' must be > 0"},
        {R"({"type": "box", "size": [1, 1, 1], "min": [0, 0, 0]})", "give 'size' or 'min'"},
        {R"({"type": "quad", "corners": [[0,0,0], [1,0,0], [2,0,0], [3,0,0]]})", "have no area"},
        {R"({"type": "quad", "corners": 4})", "expected 4 arrays of 3 numbers for 'corners'"},
        {R"({"type": "mesh"})", "a mesh needs a 'filepath'"},
        {R"({"type": "mesh", "filepath": 7})", "expected a text for 'filepath'"},
        {R"({"type": "mesh", "filepath": "none.obj"})", "no file 'none.obj'"},
        {R"({"type": "mesh", "filepath": "broken.obj"})", "expected a number after 'v'"},
        {R"({"type": "mesh", "filepath": "mesh.stl"})", "unknown mesh format '.stl'"},
        {R"({"type": "instance"})", "an instance needs a 'ref'"},
        {R"({"type": "instance", "ref": "gear"})", "no earlier object is named 'gear'"},
        {R"({"type": "node", "ref": "gear"})", "no earlier"},
        {R"({"type": "node", "children": 1})", "expected an array for 'children'"},
        {R"({"type": "node", "children": [1]})", "expected an object in 'objects'"},
        {R"({"type": "node", "keys": [{}, {}], "children": [{"type": "sphere", "keys": [{}, {}, {}]}]})",
         "need the same count"},
    };
    checkRows(scenes, rows, [](const std::string& object) {
        return cat("{", kCamera, R"(, "objects": [)", kBall, ",", object, "]}");
    });
    // Of meshes only those go that cannot be read, and what shows them.
    const auto read = scenes.read(
        cat("{", kCamera, R"(, "objects": [{"name": "a", "type": "mesh", "filepath": "none.obj"},
            {"type": "instance", "ref": "a"}, {"name": "b", "type": "mesh", "filepath": "triangle.obj"},
            {"type": "instance", "ref": "b", "position": [0, 1, 0]}]})"),
        true);
    CHECK_INFO(read.error.empty(), read.error);
    CHECK_EQUAL(read.scene.desc.meshes.size(), std::size_t{1});
    CHECK_EQUAL(read.scene.desc.objects.size(), std::size_t{2});
    CHECK(read.scene.desc.objects.at(0).mesh == 0 && read.scene.desc.objects.at(1).mesh == 0);
}

TEST(json_lenient_materials_and_textures) {
    const Scenes scenes;
    const std::vector<Row> rows = {
        {R"("materials": 3)", "expected an array for 'materials'"},
        {R"("materials": ["red"])", "expected an object for a material"},
        {R"("materials": [{"name": 5}])", "expected a text for 'name'"},
        {R"("materials": [{"ID": 0.5}])", "expected a whole number for 'ID'"},
        {R"("materials": [{"name": "m", "diffuse": "red"}])", "for 'diffuse', got the text 'red'"},
        {R"("materials": [{"name": "m", "diffuse": [1, 2]}])", "for 'diffuse', got an array of 2"},
        {R"("materials": [{"name": "m", "mirror": "yes"}])", "for 'mirror', got the text 'yes'"},
        {R"("materials": [{"name": "m", "mirror": -1}])", "'mirror' must be"},
        {R"("materials": [{"name": "m", "ior": true}])", "for 'ior', got true"},
        {R"("materials": [{"name": "m", "fresnel": true}])", "for 'fresnel', got true"},
        {R"("materials": [{"name": "m", "hardness": 1, "shininess": 2}])", "give 'hardness' or"},
        {R"("materials": [{"name": "m", "bump_map": "noise"}])", "unknown texture 'noise'"},
        {R"("materials": [{"name": "m", "bump_map": {"type": "noise"}}])",
         "for 'bump_map', got an"},
        {R"("textures": [{"name": "t", "type": "noise"}])", "a texture needs a 'file'"},
        {R"("textures": [{"file": "t.png"}])", "a texture needs a 'name'"},
        {R"("textures": [7])", "expected an object for a texture, got the number 7"},
        {R"("textures": [{"name": "t", "file": ""}])", "a texture needs a 'file'"},
    };
    checkRows(scenes, rows, [](const std::string& part) {
        return cat("{", kCamera, ",", part, R"(, "objects": [)", kBall, "]}");
    });
}

TEST(json_lenient_lights_and_settings) {
    const Scenes scenes;
    const std::vector<Row> rows = {
        {R"("lights": {"type": "point"})", "expected an array for 'lights'"},
        {R"("lights": [{}])", "a light needs a 'type'"},
        {R"("lights": [{"type": "moon"}])", "unknown type of light 'moon'"},
        {R"("lights": [{"type": "point", "colour": [1]}])", "for 'colour', got 1"},
        {R"("lights": [{"type": "point", "power": -1}])", "'power' must be"},
        {R"("lights": [{"type": "point", "attenuation": [0, 0, 0]}])", "light without end"},
        {R"("lights": [{"type": "directional", "direction": [0, 0, 0]}])", "is 0 0 0"},
        {R"("lights": [{"type": "spot", "lookAt": [0, 0, 0]}])", "is its own position"},
        {R"("lights": [{"type": "spot", "direction": [0, 1, 0], "lookAt": [1, 1, 1]}])",
         "give 'direction' or 'lookAt', not both"},
        {R"("resolution": "small")", "for 'resolution', got the text 'small'"},
        {R"("resolution": [0, 10])", "from 1 to 65535 for 'resolution'"},
        {R"("AA_samples": 2.5)", "for 'AA_samples', got the number 2.5"},
        {R"("AA": 3)", "expected an object for 'AA', got the number 3"},
        {R"("AA": {"samples": 2}, "AA_samples": 4)", "give 'AA', or 'AA_samples'"},
        {R"("settings": {"samples": 4}, "AA_samples": 4)", "give one"},
        {R"("settings": {"crop": [5, 5, 5, 9]})", "'crop' is empty"},
        {R"("settings": {"crop": [0, 0, 5000, 9]})", "'crop' ends at 5000 9, outside the"},
        {R"("settings": {"sampler": "sobl"})", "unknown sampler 'sobl'"},
        {R"("world": 1)", "expected an object for 'world'"},
        {R"("world": {"environment": "sky"})", "unknown texture 'sky'"},
        {R"("ambient": [0, 0, 0], "world": {"ambient": [1, 1, 1]})", "keep one of them"},
        {R"("fog": 1)", "unknown key 'fog' of the scene"},
        {R"("ambient": [0, 0, 0], "ambient": [1, 1, 1])", "the key 'ambient' was given already"},
    };
    checkRows(scenes, rows, [](const std::string& part) {
        return cat("{", kCamera, ",", part, R"(, "objects": [)", kBall, "]}");
    });
}

TEST(json_lenient_cameras) {
    const Scenes scenes;
    const std::vector<Row> rows = {
        {R"("position": 3)", "expected an array of 3 numbers for 'position'"},
        {R"("position": [1, 1, 1], "lookAt": [1, 1, 1])", "is its own position"},
        {R"("position": [0, 5, 0])", "is parallel to the view"},
        {R"("position": [0, 0, 5], "up": [0, 0, 0])", "'up' of the camera has no direction"},
        {R"("position": [0, 0, 5], "fov": 180)", "'fov' must be > 0 and at most 179.999"},
        {R"("position": [0, 0, 5], "fov": 40, "fovy": 40)", "give 'fov' or 'fovy', not both"},
        {R"("position": [0, 0, 5], "type": "fisheye")", "unknown type 'fisheye'"},
        {R"("position": [0, 0, 5], "zoom": 2)", "unknown key 'zoom' of the camera"},
    };
    checkRows(scenes, rows, [](const std::string& camera) {
        return cat("{\"camera\": {", camera, R"(}, "objects": [)", kBall, "]}");
    });
}

// Without a camera, and with more than memory holds, there is nothing to render.
TEST(json_lenient_has_ends) {
    const Scenes scenes;
    for (const auto& [text, words] :
         {std::pair(std::string("[1, 2"), "expected ',' or ']'"),
          std::pair(std::string("[]"), "the scene has no camera"),
          std::pair(std::string(R"({"objects": []})"), "the scene has no camera"),
          std::pair(std::string(R"({"camera": {"fov": NaN}})"), "JSON has finite numbers only")}) {
        const auto read = scenes.read(text, true);
        CHECK_INFO(read.error.find(words) != std::string::npos, text << " says " << read.error);
    }
    std::string objects = kBall;
    for (int i = 0; i < 30; ++i)
        objects += cat(R"(,{"type": "node", "name": "n)", i, R"(", "children": [)",
                       R"({"type": "instance", "ref": ")", i == 0 ? "ball" : cat("n", i - 1),
                       R"("}, {"type": "instance", "ref": ")", i == 0 ? "ball" : cat("n", i - 1),
                       R"("}]})");
    const auto read = scenes.read(cat("{", kCamera, R"(, "objects": [)", objects, "]}"), true);
    CHECK_INFO(read.error.find("more than 1048576") != std::string::npos, read.error);
}

} // namespace test_json_lenient
