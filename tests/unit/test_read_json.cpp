// Scenes in JSON: the dialects of the course with their quirks, by numbers worked out by hand, and
// the keys that are rows of the native tables. What is refused is in tests/bad/json.
#include "desc/properties.h"
#include "desc/validate.h"
#include "unit/damage.h"
#include "unit/json_kit.h"

#include <filesystem>

namespace test_read_json {

using damage::contentOf;
using json_kit::checkColor;
using json_kit::hasWarning;
using json_kit::read;
using json_kit::Reading;
using json_kit::scene;

namespace fs = std::filesystem;

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
    const SettingsDesc grid = scene(R"({"AA": {"jitter": true, "samples": 3}})").settings;
    CHECK_EQUAL(grid.samplesPerPixel, 9);
    CHECK(grid.sampler == SettingsDesc::Sampler::Grid && grid.jitter);
    // Since autumn 2024 they are all samples of a pixel; without jitter all are one.
    struct Row {
        std::string aa, warning;
        int samples;
        bool jitter;
    };
    const Row rows[] = {
        {R"("AA_jitter": true, "AA_samples": 32)", "", 32, true},
        {R"("AA_samples": 32, "AA_jitter": true)", "", 32, true},
        {R"("AA_jitter": true)", "", 1, true},
        {R"("AA_samples": 1)", "", 1, false},
        {R"("AA_samples": 9)", "without 'AA_jitter' all 9 samples", 1, false},
        {R"("AA_jitter": false, "AA_samples": 9)", "one is taken", 1, false},
        {R"("AA_samples": -1)", "renders without end", 1, false},
        {R"("AA_jitter": true, "AA_samples": -1)", "64 per pixel are taken", 64, true},
        {R"("AA_jitter": true, "AA_samples": 0)", "64 per pixel are taken", 64, true},
    };
    for (const std::string fov : {"fov", "fovy"}) // autumn 2024, and 2025
        for (const Row& row : rows) {
            const Reading reading = read(
                cat("{", row.aa, R"(, "camera": {")", fov, R"(": 40, "position": [0, 0, 5]}})"));
            const SettingsDesc& s = reading.desc.settings;
            CHECK_EQUAL(s.samplesPerPixel, row.samples);
            CHECK_EQUAL(s.jitter, row.jitter);
            CHECK((s.sampler == SettingsDesc::Sampler::Grid) == !row.jitter);
            const std::string said = join(reading.warnings);
            CHECK_INFO(row.warning.empty() ? said.empty()
                                           : said.find(row.warning) != std::string::npos,
                       row.aa << ": " << said);
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
    for (const auto& row : propertiesOf(BlockType::Settings))
        check(row.keyword, "\"settings\": {", "}");
    for (const auto& row : propertiesOf(BlockType::World)) check(row.keyword, "\"world\": {", "}");
    for (const auto& row : propertiesOf(BlockType::Camera))
        check(row.keyword, "\"camera\": {\"position\": [1, 1, 1],", "}");
    for (const auto& row : propertiesOf(BlockType::Texture))
        check(row.keyword, "\"textures\": [{\"name\": \"t\",", "}]");
    for (const auto& row : propertiesOf(BlockType::Material))
        check(row.keyword, "\"materials\": [{", "}]");
    for (const auto& row : propertiesOf(BlockType::Light))
        if (row.keyword != "type")
            check(row.keyword, "\"lights\": [{\"type\": \"spot\", \"name\": \"s\",", "}]");
    for (const std::string type : {"sphere", "plane", "quad", "disk", "cylinder", "cone", "cube"}) {
        const ObjectDesc::Kind kind =
            scene(cat(R"({"objects": [{"type": ")", type, "\"}]}")).objects.at(0).kind;
        for (const auto& row : propertiesOf(BlockType::Object))
            if (row.kinds & only(kind))
                check(row.keyword, cat(R"("objects": [{"type": ")", type, "\", "), "}]");
    }
    CHECK_INFO(count > 90, count);
}

// Scenes stand in the pages between lines ```json and ```.
TEST(read_json_examples_of_the_page) {
    const std::string page = contentOf("ASCII/JSON.md"), fence = "\n```json\n";
    std::size_t count = 0;
    for (std::size_t at = 0; (at = page.find(fence, at)) != std::string::npos; ++count) {
        at += fence.size();
        const SourceFile source{"page.json", page.substr(at, page.find("\n```\n", at) - at)};
        Diagnostics diagnostics;
        const std::string message = check::thrown([&] {
            validate(readJson(source, {{}, diagnostics}), source, diagnostics);
        });
        CHECK_INFO(message.empty() && diagnostics.warnings.empty(),
                   message << join(diagnostics.warnings));
    }
    CHECK_EQUAL(count, std::size_t{2});
}

// The page has every key that is a keyword of a native block too.
TEST(read_json_page_is_complete) {
    const std::string page = contentOf("ASCII/JSON.md");
    for (const BlockType type : {BlockType::Settings, BlockType::World, BlockType::Camera,
                                 BlockType::Texture, BlockType::Material, BlockType::Light})
        for (const Property& row : propertiesOf(type)) {
            CHECK_INFO(page.find(cat("`", row.keyword, "`")) != std::string::npos, row.keyword);
            for (const std::string_view name : row.first.names)
                CHECK_INFO(page.find(cat("\"", name, "\"")) != std::string::npos ||
                               page.find(cat("`", name, "`")) != std::string::npos,
                           row.keyword << " " << name);
        }
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

} // namespace test_read_json
