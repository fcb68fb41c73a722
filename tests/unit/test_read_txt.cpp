// The native reader: what it reads. What it refuses is in tests/bad/txt (test_bad_scenes.cpp).
#include "read/txt/read_txt.h"

#include "base/text.h"
#include "check.h"
#include "desc/lobes.h"
#include "desc/properties.h"
#include "read/load.h"
#include "read/txt/read_blocks.h"
#include "unit/damage.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

namespace test_read_txt {

namespace {

using damage::contentOf;

SceneDesc readText(const std::string& text) { return readTxt({"t.txt", text}); }
SceneDesc readBody(const std::string& body) { return readText("raytracer 1\n" + body); }
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}
Rows rowsOf(const std::string& lines) {
    return readBody("sphere s {\n" + lines + "\n}\n").objects.at(0).worldFromObject.at(0);
}
void checkRows(const Rows& rows, const Rows& expected) {
    for (std::size_t i = 0; i < rows.size(); ++i) CHECK_NEAR(rows[i], expected[i], 4e-16);
}

const std::string kEverything = "tests/scenes/everything.txt";

} // namespace

TEST(read_txt_smallest_scene_has_defaults) {
    CHECK(readText("raytracer 1") == SceneDesc{});
    CHECK(readText("raytracer 1\n\n# nothing\n") == SceneDesc{});
    const SceneDesc desc = readBody("camera c {\n}\nsphere s {\n}\nsettings {\n}\nworld {\n}");
    CameraDesc camera;
    camera.name = "c";
    CHECK(desc.cameras.at(0) == camera);
    ObjectDesc sphere;
    sphere.name = "s";
    CHECK(desc.objects.at(0) == sphere);
    CHECK(desc.settings == SettingsDesc{} && desc.world == WorldDesc{});
}

TEST(read_txt_everything) {
    Diagnostics diagnostics;
    const SceneDesc desc = load(kEverything, diagnostics).desc;
    CHECK_INFO(diagnostics.warnings.empty(), join(diagnostics.warnings));
    CHECK_EQUAL(desc.settings.width, 64);
    CHECK_EQUAL(desc.settings.height, 48);
    CHECK((desc.settings.crop == std::array<int, 4>{4, 2, 60, 40}));
    CHECK(desc.settings.sampler == SettingsDesc::Sampler::Stratified && !desc.settings.jitter);
    CHECK(desc.settings.filter == SettingsDesc::Filter::Gaussian &&
          desc.settings.filterWidth == 2.5);
    CHECK_EQUAL(desc.settings.seed, 4294967295u);
    CHECK((desc.world.background == Rgbd{0.1, 0.2, 0.3}));
    CHECK_EQUAL(desc.world.environment, 0);
    CHECK_EQUAL(desc.cameras.size(), std::size_t{2});
    CHECK_EQUAL(desc.cameras[0].sensorHeightMm, 18.0);
    CHECK_EQUAL(desc.cameras[0].shiftY, -0.2);
    CHECK_EQUAL(desc.cameras[1].name, "from above");
    CHECK_EQUAL(desc.cameras[1].worldFromCamera.size(), std::size_t{2});
    CHECK_EQUAL(desc.textures.at(0).file, "sky \"wide\".ppm");
    CHECK(desc.textures.at(1).channel == TextureDesc::Channel::Alpha);
    CHECK(desc.lights.at(1).kind == LightDesc::Kind::Spot && desc.lights[1].cosineFalloff);
    CHECK_EQUAL(desc.materials.at(0).name, "Größe 2");
    CHECK_EQUAL(desc.materials[0].bumpMap, 1);
    CHECK_EQUAL(desc.materials[0].ior, 1.33);
    CHECK_EQUAL(desc.objects.size(), std::size_t{10});
    CHECK((desc.objects[0].materials == std::vector<Handle>{1}));
    CHECK((desc.objects[7].materials == std::vector<Handle>{1, 0}));
    CHECK_EQUAL(desc.objects[8].mesh, 0); // the mesh comes last in the file
    const MeshDesc& mesh = desc.meshes.at(0);
    CHECK((mesh.points.at(4) == Vec3d{0, 0, 1.5}));
    CHECK((mesh.triangles.at(5) == MeshDesc::Corners{3, 0, 4}));
    CHECK((mesh.uvs.at(2) == Vec2{0.5f, 1}));
    CHECK((mesh.triangleMaterials == std::vector<std::uint32_t>{0, 0, 1, 1, 1, 1}));
    const MeshDesc& square = desc.meshes.at(1);
    CHECK(square.file.empty() && square.name == "square");
    CHECK((square.points == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    CHECK((square.triangles == std::vector<MeshDesc::Corners>{{0, 1, 2}, {0, 2, 3}}));
    CHECK((square.normals.at(0) == Vec3{0, 0, 1}));
}

TEST(read_txt_everything_is_everything) {
    const std::string text = contentOf(kEverything);
    const auto checkUsed = [&](std::string_view keyword) {
        CHECK_INFO(text.find(cat("\n    ", keyword, " ")) != std::string::npos ||
                       text.find(cat("\n    ", keyword, "\n")) != std::string::npos ||
                       text.find(cat("\n", keyword, " ")) != std::string::npos,
                   "no '" << keyword << "' in " << kEverything);
    };
    for (const BlockType type : kValuesOf<BlockType>)
        for (const Property& row : propertiesOf(type)) checkUsed(row.keyword);
    const MeshDesc mesh;
    forEachArray(mesh,
                 [&](std::string_view keyword, auto&, std::string_view) { checkUsed(keyword); });
    for (const TransformLine& line : transformLines()) checkUsed(line.keyword);
    for (const auto kind : kNamesByValue<ObjectDesc::Kind>) checkUsed(kind);
    checkUsed("lobe");
}

TEST(read_txt_lobes) {
    const SceneDesc desc = readText(contentOf(kEverything));
    const std::vector<LobeDesc>& lobes = desc.materials.at(2).lobes;
    CHECK_EQUAL(lobes.size(), LobeDesc::kMost);
    const auto formOf = [](const LobeDesc& lobe) { return lobeForms()[lobe.kind]; };
    CHECK_EQUAL(formOf(lobes[0]).name, "coat");
    CHECK((lobes[0].covers && lobes[0].weight == Rgbd{0.5, 0.5, 0.5}));
    CHECK((lobes[0].factors ==
           std::vector<LobeDesc::Factor>{{.without = true, .texture = 1, .strength = 0.25}}));
    const LobeDesc& conductor = lobes[2];
    CHECK_EQUAL(formOf(conductor).name, "conductor");
    CHECK(!conductor.covers);
    CHECK((conductor.numbers ==
           std::array<double, LobeDesc::kNumbers>{0.9, 0.6, 0.3, 1, 0.9, 0.8, 0.25, 0.5, 30}));
    using Factor = LobeDesc::Factor;
    CHECK((conductor.factors == std::vector<Factor>{{.texture = 1}, // wood, sky and wood
                                                    {.texture = 0},
                                                    {.field = 2, .texture = 1}}));
    CHECK(lobes[5].numbers == formOf(lobes[5]).usual.numbers); // nothing is said
    // Values in any order are the same lobe, and lines may go on behind a comment sign.
    const auto lobeOf = [](const std::string& line) {
        return readBody("texture a {\nfile f\n}\ntexture b {\nfile f\n}\nmaterial m {\n" + line +
                        "\n}")
            .materials.at(0)
            .lobes.at(0);
    };
    CHECK(lobeOf("lobe conductor roughness 0.1 times a weight 1 0 0 times b # c") ==
          lobeOf("lobe\tconductor weight 1 0 0 times b roughness 0.1 times a"));
    CHECK(lobeOf("lobe conductor covers roughness 0.1") ==
          lobeOf("lobe conductor roughness .1 covers"));
    CHECK(lobeOf("lobe diffuse weight 1 1 1 without \"a\" 1 times b") ==
          lobeOf("lobe diffuse weight 1 1 1 without a times \"b\""));
}

// A lobe takes the place of the diffuse surface that a material has by itself.
TEST(read_txt_lobes_and_diffuse) {
    const auto diffuseOf = [](const std::string& lines) {
        return readBody("material m {\n" + lines + "\n}").materials.at(0).diffuse;
    };
    const Rgbd usual{0.8, 0.8, 0.8}, said{0.5, 0, 0};
    CHECK(diffuseOf("mirror 1 1 1") == usual);
    CHECK(diffuseOf("lobe mirror") == Rgbd{});
    CHECK(diffuseOf("lobe mirror\nlobe diffuse") == Rgbd{});
    CHECK(diffuseOf("lobe mirror\ndiffuse 0.5 0 0") == said);
    CHECK(diffuseOf("diffuse 0.5 0 0\nlobe mirror") == said);
    // As in the block before, which is read faster.
    const SceneDesc desc =
        readBody("material a {\ndiffuse 0.5 0 0\n}\nmaterial b {\ndiffuse 0.5 0 0\n"
                 "lobe mirror\n}\nmaterial c {\nlobe mirror\n}");
    CHECK(desc.materials.at(1).diffuse == said && desc.materials.at(2).diffuse == Rgbd{});
}

TEST(read_txt_endless_distance) {
    const auto distance = [](const std::string& words) {
        return readBody("world {\nambient_occlusion " + words + "\n}").world.ambientOcclusion;
    };
    CHECK_EQUAL(distance("inf"), kEndless);
    CHECK_EQUAL(distance("2.5"), 2.5);
    CHECK_THROWS(distance("-inf"), "'-inf' is not a finite number");
    CHECK_THROWS(distance("nan"), "'nan' is not a finite number");
    CHECK_THROWS(distance("-1"), "'ambient_occlusion' must be >= 0, got -1");
    CHECK_THROWS(distance("inf inf"),
                 "expected the end of the line after 'ambient_occlusion', got 'inf'");
    CHECK_THROWS(readBody("camera c {\nlens inf\n}"), "'inf' is not a finite number");
}

// The spec names every keyword and every choice.
TEST(read_txt_readme_is_complete) {
    const std::string readme = contentOf("ASCII/README.md");
    const auto check = [&](std::string_view keyword) {
        CHECK_INFO(readme.find(cat("    ", keyword, " ")) != std::string::npos, keyword);
    };
    for (const BlockType type : kValuesOf<BlockType>)
        for (const Property& row : propertiesOf(type)) {
            check(row.keyword);
            for (const std::string_view name : row.first.names)
                CHECK_INFO(readme.find(name) != std::string::npos, row.keyword << " " << name);
        }
    const MeshDesc mesh;
    forEachArray(mesh, [&](std::string_view keyword, auto&, std::string_view) { check(keyword); });
    for (const TransformLine& line : transformLines())
        CHECK_INFO(readme.find(cat("| `", line.keyword, " ")) != std::string::npos, line.keyword);
    // A row "| `coat` | `ior` 1.5, `tint` 1 1 1, `roughness` 0.03 |" for each lobe.
    for (const LobeForm& form : lobeForms()) {
        std::string row = cat("| `", form.name, "` | ");
        for (const LobeFieldForm& field : form.fields) {
            row += cat(field.first > 0 ? ", " : "", "`", field.name, "`");
            for (std::size_t i = 0; i < field.count; ++i)
                row += " " + shortest(form.usual.numbers[field.first + i]);
        }
        CHECK_INFO(readme.find(row + " |") != std::string::npos, row);
    }
}

TEST(read_txt_values_of_points_need_no_corners) {
    const std::string points = "points 4\n0 0 0 1 0 0 1 1 0 0 1 0\n";
    const std::string triangles = "triangles 2\n0 1 2 0 2 3\n";
    const std::string values = "normals 4\n0 0 1 0 0 1 0 0 1 0 1 0\nuvs 4\n0 0 1 0 1 1 0 1\n";
    for (const std::string& body : {points + triangles + values, values + triangles + points}) {
        const MeshDesc mesh = readBody("mesh m {\n" + body + "}\n").meshes.at(0);
        CHECK(mesh.normalTriangles == mesh.triangles && mesh.uvTriangles == mesh.triangles);
    }
    const MeshDesc three =
        readBody("mesh m {\n" + points + triangles + "normals 3\n0 0 1 0 0 1 0 1 0\n}\n")
            .meshes.at(0);
    CHECK(three.normalTriangles.empty()); // which validate() refuses
}

TEST(read_txt_line_ends_and_marks) {
    const std::string text = contentOf(kEverything);
    const SceneDesc desc = readText(text);
    CHECK(readText(replaced(text, "\n", "\r\n")) == desc);
    CHECK(readText("\xef\xbb\xbf" + text) == desc);
    CHECK(readText(text.substr(0, text.size() - 1)) == desc); // no newline at the end
    CHECK(readText(replaced(text, "    ", "\t")) == desc);
    CHECK(readText(replaced(text, "\n", " # note\n")) == desc);
    CHECK(readText(replaced(text, "\n", "\n\n")) == desc);
}

TEST(read_txt_long_lines_and_names) {
    const std::string name(1 << 20, 'n');
    const SceneDesc desc =
        readBody("material \"" + name + "\" {\n}\nsphere s {" + std::string(1 << 20, ' ') +
                 "\n    material " + name + "#" + std::string(1 << 20, 'c') + "\n}\n");
    CHECK(desc.materials.at(0).name == name);
    CHECK_EQUAL(desc.objects.at(0).materials.at(0), 0);
    const std::string message =
        check::thrown([&] { readBody("sphere s {\n    material " + name + "\n}\n"); });
    CHECK(message.size() < 1000 && message.find("t.txt:3:14: error: unknown material 'nnn") == 0);
}

// A wrong name among very many must not take long, nor all of them be shown.
TEST(read_txt_many_unknown_names) {
    std::string body;
    for (int i = 0; i < 20000; ++i)
        body += cat("material m", i, " {\n}\nsphere s", i, " {\n    material x", i, "\n}\n");
    const std::string message = check::thrown([&] { readBody(body); });
    CHECK(message.size() < 20000);
    CHECK(message.find("t.txt: error: and 19980 more errors") != std::string::npos);
}

TEST(read_txt_transform_lines) {
    checkRows(rowsOf("translate 1 2 3"), {1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3});
    checkRows(rowsOf("scale 1 2 3"), {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0});
    checkRows(rowsOf("rotate 90 0 0 2"), {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0});
    checkRows(rowsOf("rotate 90 1e-200 0 0"), {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0});
    checkRows(rowsOf("transform 1 2 3 4  5 6 7 8  9 10 12 13"),
              {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 13});
    // Scale first, translate last: (1,0,0) -> (2,0,0) -> (0,2,0) -> (1,4,3).
    checkRows(rowsOf("translate 1 2 3\nrotate 90 0 0 1\nscale 2 2 2"),
              {0, -2, 0, 1, 2, 0, 0, 2, 0, 0, 2, 3});
    // At e, -Z towards t, +Y towards u.
    checkRows(rowsOf("look_at 0 -5 1  0 0 1  0 0 1"), {1, 0, 0, 0, 0, 0, -1, -5, 0, 1, 0, 1});
}

TEST(read_txt_one_number_scales_all) {
    checkRows(rowsOf("scale 3"), rowsOf("scale 3 3 3"));
    checkRows(rowsOf("translate 1 2 3\nscale 2 # all"), rowsOf("translate 1 2 3\nscale 2 2 2"));
    CHECK_THROWS(rowsOf("scale 2 3"), "expected 3 numbers after 'scale', got 2");
    CHECK_THROWS(rowsOf("scale"), "expected 3 numbers after 'scale', got none");
    CHECK_THROWS(rowsOf("translate 2"), "expected 3 numbers after 'translate', got 1");
}

// The lens is half the fitted side of the sensor over the tangent of half the angle.
TEST(read_txt_field_of_view) {
    const auto lens = [](const std::string& lines) {
        const CameraDesc camera = readBody("camera c {\n" + lines + "\n}\n").cameras.at(0);
        return camera.lensMm;
    };
    CHECK_NEAR(lens("fov 90"), 18, 1e-13);
    CHECK_NEAR(lens("fov 60\nsensor 20 30"), 10 * std::sqrt(3.0), 1e-13);
    CHECK_NEAR(lens("fov 90\nsensor_fit vertical"), 12, 1e-13);
    CHECK_NEAR(lens("sensor 40 30\nsensor_fit horizontal\nfov 90"), 20, 1e-13);
    CHECK_EQUAL(lens("sensor 36 20"), 50.0);
    CHECK_EQUAL(lens("lens 35"), 35.0);
}

TEST(read_txt_keys) {
    const auto keysOf = [](const std::string& lines) {
        return readBody("cube c {\n" + lines + "\n}\n").objects.at(0).worldFromObject;
    };
    CHECK((keysOf("") == Keys{kIdentityRows}));
    CHECK((keysOf("key") == Keys{kIdentityRows, kIdentityRows}));
    const Rows moved{1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0};
    CHECK((keysOf("translate 1 0 0\nkey\nkey\ntranslate 1 0 0") ==
           Keys{moved, kIdentityRows, moved}));
}

TEST(read_txt_places_of_blocks) {
    const std::string text = contentOf(kEverything);
    const SceneDesc desc = readText(text);
    const auto checkPlace = [&](SourceLoc loc, std::string_view word) {
        CHECK_INFO(std::string_view(text).substr(loc.offset).starts_with(word),
                   word << " at " << loc.offset);
    };
    checkPlace(desc.settings.loc, "settings {");
    checkPlace(desc.world.loc, "world {");
    checkPlace(desc.cameras[1].loc, "camera \"from above\"");
    checkPlace(desc.meshes[0].loc, "mesh pyramid");
    checkPlace(desc.objects[8].loc, "instance two");
    CHECK_EQUAL(SceneDesc{}.world.loc.offset, SourceLoc::kUnknown);
}

TEST(read_txt_arrays_over_lines) {
    const SceneDesc desc = readBody(
        "mesh m {\n points 2 0 1 2 # first\n3\n4 # two\n\n5\n triangles 1\n0 1 0\r\n uvs 0\n}\n");
    CHECK((desc.meshes.at(0).points == std::vector<Vec3d>{{0, 1, 2}, {3, 4, 5}}));
    CHECK(desc.meshes[0].uvs.empty());
}

TEST(load_files) {
    Diagnostics d;
    CHECK_EQUAL(load(kEverything, d).source.name, kEverything);
    CHECK_THROWS(load("tests/scenes/everythin.txt", d),
                 "tests/scenes/everythin.txt: error: cannot read: no such file; did you mean "
                 "'tests/scenes/everything.txt'?");
    CHECK_THROWS(load("no/such/folder/a.txt", d),
                 "no/such/folder/a.txt: error: cannot read: no such file");
    CHECK_THROWS(load("", d), "error: cannot read: no such file");
    CHECK_THROWS(load("tests/scenes", d), "tests/scenes: error: cannot read: it is a folder");
    CHECK_THROWS(load("ASCII/README.md", d), "ASCII/README.md: error: unknown scene format '.md'");
    CHECK_THROWS(load("/dev/null", d), "/dev/null: error:");
}

} // namespace test_read_txt
