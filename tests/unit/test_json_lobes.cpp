// Lobes of materials in JSON: the same that the native text says. What is refused is in
// tests/bad/json.
#include "desc/range.h"
#include "read/txt/read_txt.h"
#include "unit/json_kit.h"

namespace test_json_lobes {

using namespace json_kit;

namespace {

const std::string kTextures =
    R"("textures": [{"name": "a", "file": "a.png"}, {"name": "b", "file": "b.png"}],)";
Reading readMaterial(const std::string& members, bool lenient = false) {
    return read(cat(R"({"camera": {"position": [1, 1, 1]},)", kTextures, R"("materials": [{)",
                    members, "}]}"),
                lenient);
}
MaterialDesc material(const std::string& members) {
    const Reading reading = readMaterial(members);
    CHECK_INFO(reading.warnings.empty(), join(reading.warnings));
    return reading.desc.materials.at(0);
}
std::vector<LobeDesc> native(const std::string& lines) {
    const std::string textures = "texture a {\n file a.png\n}\ntexture b {\n file b.png\n}\n";
    return readTxt({"t.txt", cat("raytracer 1\n", textures, "material m {\n", lines, "\n}\n")})
        .materials.at(0)
        .lobes;
}

} // namespace

TEST(json_lobes_are_those_of_the_native_text) {
    const auto check = [](const std::string& json, const std::string& lines) {
        CHECK_INFO(material(cat("\"lobes\": [", json, "]")).lobes == native(lines), json);
    };
    check(R"({"type": "diffuse"}, {"type": "mirror", "weight": 0.5})",
          "lobe diffuse\nlobe mirror weight 0.5 0.5 0.5");
    check(R"({"type": "coat", "covers": true, "ior": 1.4, "tint": [0.9, 0.8, 0.7]})",
          "lobe coat ior 1.4 tint 0.9 0.8 0.7 covers");
    check(R"({"type": "conductor", "roughness": {"value": 0.25, "factors": [{"times": "b"}]},
              "weight": {"factors": [{"without": "a", "strength": 0.5}, {"times": "b"}]}})",
          "lobe conductor weight 1 1 1 without a 0.5 times b roughness 0.25 times b");
    check(R"({"type": "conductor", "color": {"value": 0.25, "factors": [{"without": "b"}]}})",
          "lobe conductor color 0.25 0.25 0.25 without b");
    CHECK(material(R"("lobes": [])").lobes.empty());
}

// A material with lobes is diffuse only where that is said, and turns its normals to the eye, as
// what light passes through or comes back from does.
TEST(json_lobes_take_the_place_of_the_course) {
    const std::string lobes = R"("lobes": [{"type": "mirror"}])";
    CHECK(material(lobes).diffuse == Rgbd{});
    CHECK(material(lobes).litSide == MaterialDesc::LitSide::Eye);
    CHECK((material(lobes + R"(, "diffuse": [0.5, 0, 0])").diffuse == Rgbd{0.5, 0, 0}));
    CHECK((material(R"("lobes": [])").diffuse == Rgbd{0.8, 0.8, 0.8}));
    CHECK(material(R"("lobes": [])").litSide == MaterialDesc::LitSide::Outside);
}

TEST(json_lobes_lenient) {
    const Reading reading = readMaterial(
        R"("lobes": [{"type": "mirrow"}, 7, {"weight": 1}, {"type": "mirror", "weight": -1,
                      "size": 2}, {"type": "phong", "exponent": {"factors": [{"times": "c"}]}}])",
        true);
    const std::vector<LobeDesc>& lobes = reading.desc.materials.at(0).lobes;
    CHECK(lobes == native("lobe mirror\nlobe phong"));
    for (const char* words :
         {"unknown lobe 'mirrow'; did you mean 'mirror'?",
          "expected an object for a lobe, got the number 7", "a lobe needs a 'type'",
          "'weight' must be >= 0, got -1", "unknown key 'size' of a lobe", "unknown texture 'c'"})
        CHECK_INFO(hasWarning(reading, words), words);
    std::string nine = R"("lobes": [{"type": "diffuse"})";
    for (int i = 1; i < 9; ++i) nine += R"(, {"type": "diffuse"})";
    const Reading many = readMaterial(nine + "]", true);
    CHECK_EQUAL(many.desc.materials.at(0).lobes.size(), LobeDesc::kMost);
    CHECK(hasWarning(many, "at most 8 lobes"));
}

TEST(json_endless_distance) {
    const auto distance = [](const std::string& value) {
        return scene(cat(R"({"camera": {"position": [1, 1, 1]},)",
                         R"("world": {"ambient_occlusion": )", value, "}}"))
            .world.ambientOcclusion;
    };
    CHECK_EQUAL(distance("\"inf\""), kEndless);
    CHECK_EQUAL(distance("2"), 2.0);
    CHECK_THROWS(distance("\"far\""),
                 "expected a number for 'ambient_occlusion', got the text 'far'");
    CHECK_THROWS(scene(R"({"camera": {"position": [1, 1, 1], "lens": "inf"}})"),
                 "expected a number for 'lens'");
}

} // namespace test_json_lobes
