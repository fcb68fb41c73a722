// One small scene in three formats is one SceneDesc; and what --convert writes of any format reads
// back as the same.
#include "check.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "read/json/read_json.h"
#include "read/load.h"
#include "read/nff/read_nff.h"
#include "read/txt/read_txt.h"

#include <cmath>
#include <filesystem>

namespace test_same_scene {

namespace {

constexpr const char* kNff = R"(b 0.1 0.2 0.4
v
from 0 -8 0
at 0 0 0
up 0 0 1
angle 53.13010235415598
hither 1
resolution 40 30
l 3 -4 5 0.5 0.75 1
f 1 0.5 0.25 0.5 0.25 16 0 0
s 0.5 0 0.25 1.5
)";

// Angles of an NFF view span the centres of the rows: 2 atan(1/2) is 30/29 of it from edge to edge.
constexpr const char* kJson = R"({
    "resolution": [40, 30], "ambient": [0.5, 0.5, 0.5],
    "settings": {"transfer": "srgb", "max_depth": 4, "cutoff": 0, "sampler": "sobol", "samples": 16,
                 "jitter": true, "filter": ["blackman-harris", 1.5], "texture_filter": "mip"},
    "world": {"background": [0.1, 0.2, 0.4], "environment_up": "z"},
    "camera": {"position": [0, -8, 0], "lookAt": [0, 0, 0], "up": [0, 0, 1], "fov": 53.13010235415598},
    "materials": [{"name": "fill1", "diffuse": [0.5, 0.25, 0.125], "specular": [0.25, 0.25, 0.25],
                   "specular_model": "phong", "exponent": 16, "ior": 1, "mirror": [0.25, 0.25, 0.25],
                   "lit_side": "eye"}],
    "objects": [{"name": "sphere1", "type": "sphere", "position": [0.5, 0, 0.25], "radius": 1.5,
                 "materials": ["fill1"]}],
    "lights": [{"name": "light1", "type": "point", "position": [3, -4, 5], "colour": [0.5, 0.75, 1],
                "power": 1, "attenuation": [0, 0, 1]}]
})";

SceneDesc read(SceneDesc (*reader)(const SourceFile&, const ReadContext&), const char* name,
               const std::string& text) {
    const SourceFile source{name, text};
    Diagnostics diagnostics;
    SceneDesc desc = reader(source, {{}, diagnostics});
    validate(desc, source, diagnostics);
    for (const std::string& warning : diagnostics.warnings) CHECK_INFO(false, warning);
    return desc;
}

// Equal but for what readers must compute from other words: within a few ulp there.
void checkClose(double& a, double b) {
    CHECK_NEAR(a, b, 1e-12 * std::fabs(b));
    a = b;
}

} // namespace

TEST(same_scene_in_three_formats) {
    SceneDesc nff = read(readNff, "s.nff", kNff);
    const SceneDesc json = read(readJson, "s.json", kJson);
    const SceneDesc txt = readTxt({"s.txt", writeTxt(nff)});
    CHECK(txt == nff);
    CHECK_EQUAL(nff.cameras.size(), std::size_t{1});
    CHECK_EQUAL(json.cameras.size(), std::size_t{1});
    // Names that NFF does not have, the lens from two readings of the angle, and how a radius is
    // said: in the transform or as a number.
    nff.cameras[0].name = json.cameras[0].name;
    nff.cameras[0].lensMm *= 30.0 / 29.0;
    checkClose(nff.cameras[0].lensMm, json.cameras[0].lensMm);
    for (std::size_t i = 0; i < 12; ++i)
        checkClose(nff.cameras[0].worldFromCamera[0][i], json.cameras[0].worldFromCamera[0][i]);
    CHECK(nff.settings == json.settings);
    CHECK(nff.world == json.world);
    CHECK(nff.cameras == json.cameras);
    CHECK(nff.materials == json.materials);
    CHECK(nff.lights == json.lights);
    CHECK(nff.objects == json.objects);
    CHECK(nff == json);
}

TEST(converted_scenes_read_back_equal) {
    namespace fs = std::filesystem;
    std::size_t count = 0;
    for (const char* folder :
         {"ASCII", "tests/scenes/json", "tests/scenes/nff", "tests/scenes/ply"})
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".json" && extension != ".nff" && extension != ".obj" &&
                extension != ".ply")
                continue;
            ++count;
            Diagnostics diagnostics;
            const SceneDesc desc = load(entry.path().string(), diagnostics).desc;
            CHECK_INFO(readTxt({"again.txt", writeTxt(desc)}) == desc, entry.path());
        }
    CHECK_INFO(count >= 25, count);
}

} // namespace test_same_scene
