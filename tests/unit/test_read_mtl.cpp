// The MTL reader: what each statement becomes, what it refuses, and damage.
#include "read/mesh/read_mtl.h"

#include "base/math.h"
#include "base/text.h"
#include "check.h"
#include "unit/damage.h"

#include <limits>

namespace test_read_mtl {

namespace {

using damage::contentOf;

struct Result : MtlFile {
    std::vector<std::string> warnings;
};
Result readText(const std::string& text) {
    Diagnostics diagnostics;
    MtlFile file = readMtl({"t.mtl", text}, {{}, diagnostics});
    return {std::move(file), diagnostics.warnings};
}
// The only material of a text without warnings.
MaterialDesc materialOf(const std::string& lines) {
    const Result file = readText("newmtl m\n" + lines);
    CHECK_INFO(file.warnings.empty(), join(file.warnings));
    return file.materials.at(0);
}
TextureDesc textureOf(const std::string& line) {
    const Result file = readText("newmtl m\n" + line);
    CHECK_INFO(file.warnings.empty(), join(file.warnings));
    return file.textures.at(0);
}
void checkColour(Rgbd c, Rgbd expected) {
    CHECK_NEAR(c.r, expected.r, 1e-15);
    CHECK_NEAR(c.g, expected.g, 1e-15);
    CHECK_NEAR(c.b, expected.b, 1e-15);
}
constexpr Rgbd kBlack{}, kWhite{1, 1, 1};

} // namespace

TEST(read_mtl_room) {
    const std::string text = contentOf("tests/scenes/obj/room.mtl");
    const Result file = readText(text);
    CHECK_INFO(file.warnings.empty(), join(file.warnings));
    CHECK_EQUAL(file.materials.size(), std::size_t{3});
    const MaterialDesc& brick = file.materials[0];
    CHECK_EQUAL(brick.name, "red brick");
    CHECK_EQUAL(text.substr(brick.loc.offset, 10), "newmtl red");
    checkColour(brick.diffuse, {0.6, 0.3, 0.2});
    checkColour(brick.specular, {0.5 / kPi, 0.5 / kPi, 0.5 / kPi});
    CHECK(brick.specularModel == MaterialDesc::SpecularModel::Blinn);
    CHECK_EQUAL(brick.exponent, 96.0);
    CHECK_EQUAL(brick.diffuseTexture, 0);
    CHECK_EQUAL(brick.bumpMap, 1); // the same file, but not the same use
    CHECK_EQUAL(brick.bumpStrength, 0.25);
    CHECK_EQUAL(file.textures.size(), std::size_t{3});
    CHECK_EQUAL(file.textures[0].name, "brick.ppm");
    CHECK_EQUAL(file.textures[1].name, "brick.ppm.2");
    CHECK((file.textures[0].scale == Vec2d{2, 3} && file.textures[0].offset == Vec2d{0.5, 0}));
    CHECK_EQUAL(text.substr(file.textures[0].fileLoc.offset, 9), "brick.ppm");
    CHECK(file.textures[0].space == TextureDesc::Space::Srgb);
    CHECK(file.textures[1].space == TextureDesc::Space::Linear);
    CHECK_EQUAL(file.materials[1].ior, 1.45);
    CHECK_EQUAL(file.materials[2].diffuseTexture, 2);
}

TEST(read_mtl_defaults) {
    MaterialDesc expected;
    expected.name = "m";
    CHECK(materialOf("") == expected);
    CHECK(readText("").materials.empty());
    CHECK(readText("# nothing\n\n").materials.empty());
    CHECK(materialOf("Ka 1 1 1\nmap_Ka a.ppm\nsharpness 60\nillum 2") == expected);
    CHECK(materialOf("Ni 0") == expected); // for what has no index
    CHECK_EQUAL(materialOf("Ni 0.9").ior, 0.9);
    checkColour(materialOf("Kd 0.25").diffuse, {0.25, 0.25, 0.25}); // one number is grey
    // With a texture and no colour, the texture alone.
    checkColour(materialOf("map_Kd a.ppm").diffuse, kWhite);
    checkColour(materialOf("map_Kd a.ppm\nKd 1 0 0").diffuse, {1, 0, 0});
    checkColour(materialOf("map_Ks a.ppm").specular, {kInvPi, kInvPi, kInvPi});
    checkColour(materialOf("map_Ke a.ppm").emission, kWhite);
    checkColour(materialOf("Ke 0 0 0\nmap_Ke a.ppm").emission, kWhite);
    checkColour(materialOf("Ke 2 1 0\nmap_Ke a.ppm").emission, {2, 1, 0});
}

TEST(read_mtl_illumination_models) {
    const std::string shine = "Kd 0.5 0.5 0.5\nKs 0.2 0.3 0.4\nNs 10\n";
    for (int illum = 0; illum <= 10; ++illum) {
        const MaterialDesc m = materialOf(shine + cat("illum ", illum));
        const bool isGlass = illum == 4 || illum == 6 || illum == 7 || illum == 9;
        const bool isMirror = illum == 3 || illum == 5 || illum == 8;
        using enum MaterialDesc::Fresnel;
        CHECK_INFO((m.specular == kBlack) == (illum < 2), illum);
        CHECK_INFO((m.mirror == Rgbd{0.2, 0.3, 0.4}) == isMirror, illum);
        CHECK_INFO((m.transmission == kWhite && m.mirror == kWhite) == isGlass, illum);
        CHECK_INFO(m.diffuse == (isGlass ? kBlack : Rgbd{0.5, 0.5, 0.5}), illum);
        CHECK_INFO(m.fresnel == (isGlass ? Dielectric : illum == 5 ? Schlick : None), illum);
        CHECK_INFO(m.opacity == 1, illum);
    }
    // The order of the statements does not matter.
    CHECK(materialOf("illum 3\n" + shine) == materialOf(shine + "illum 3"));
    // Half dissolved glass: the rest of it is diffuse, no part of the light is counted twice.
    const MaterialDesc half = materialOf("Kd 1 1 1\nTf 1 0.5 0.25\nd 0.25\nillum 7");
    checkColour(half.diffuse, {0.25, 0.25, 0.25});
    checkColour(half.transmission, {0.75, 0.375, 0.1875});
    checkColour(half.mirror, {0.75, 0.75, 0.75});
    CHECK(half.opacity == 1 && half.filter == kWhite);
    // A cut-out is no glass.
    const MaterialDesc leaf = materialOf("Kd 0 1 0\nmap_d leaf.pfm\nillum 4");
    CHECK(leaf.transmission == kBlack && leaf.mirror == kBlack && leaf.opacityTexture == 0);
    CHECK_EQUAL(materialOf("illum 3\nKs 1 1 1\nPr 0.25").roughness, 0.25);
}

// MeshLab writes Tr 1 for what is opaque. A picture of nothing helps no user.
TEST(read_mtl_all_clear_is_opaque) {
    const Result clear = readText("newmtl a\nTr 1\nnewmtl b\nTr 1.0\n");
    CHECK_EQUAL(clear.materials.at(0).opacity, 1.0);
    CHECK_EQUAL(clear.materials.at(1).opacity, 1.0);
    CHECK_EQUAL(clear.warnings.size(), std::size_t{1});
    CHECK(clear.warnings[0].find("all materials have Tr 1 and no d") != std::string::npos);
    const Result some = readText("newmtl a\nTr 1\nnewmtl b\nKd 1 1 1\n");
    CHECK_EQUAL(some.materials.at(0).opacity, 0.0);
    CHECK(some.warnings.empty());
    const Result glass = readText("newmtl a\nTr 1\nillum 7\n");
    CHECK(glass.materials.at(0).transmission.r > 0 && glass.warnings.empty());
    const Result both = readText("newmtl a\nd 0\nTr 1\n");
    CHECK_EQUAL(both.materials.at(0).opacity, 0.0);
}

TEST(read_mtl_nameless) {
    const Result file = readText("newmtl\nKd 1 0 0\n");
    CHECK_EQUAL(file.materials.at(0).name, "");
    CHECK_EQUAL(file.warnings.size(), std::size_t{1});
    CHECK(file.warnings[0].find("t.mtl:1:1: warning: this material has no name") == 0);
}

TEST(read_mtl_opacity) {
    CHECK_EQUAL(materialOf("d 0.25").opacity, 0.25);
    CHECK_EQUAL(materialOf("d -halo 0.25").opacity, 0.25);
    CHECK_EQUAL(materialOf("Tr 0.25").opacity, 0.75);
    CHECK_EQUAL(materialOf("Tr 0.75\nd 0.25").opacity, 0.25);
    checkColour(materialOf("d 0.5\nTf 1 0 0").filter, {1, 0, 0});
    const Result file =
        readText("newmtl a\nd 1\nTr 1\nnewmtl b\nd 0.5\nTr 0.5\nnewmtl c\nTr 0\nd 0\n");
    CHECK_EQUAL(file.materials.at(0).opacity, 1.0);
    CHECK_EQUAL(file.materials.at(2).opacity, 0.0);
    CHECK_EQUAL(file.warnings.size(), std::size_t{1});
    CHECK(file.warnings[0].find("t.mtl:1:1: warning: 'd' and 'Tr' contradict each other") == 0);
    CHECK(file.warnings[0].find("(2 times, the first here)") != std::string::npos);
}

TEST(read_mtl_maps) {
    // Which statement feeds what, and how the file's numbers are meant.
    struct Row {
        const char* keyword;
        Handle MaterialDesc::*texture;
        TextureDesc::Space space;
    };
    using enum TextureDesc::Space;
    for (const Row& row : {Row{"map_Kd", &MaterialDesc::diffuseTexture, Srgb},
                           Row{"map_Ks", &MaterialDesc::specularTexture, Srgb},
                           Row{"map_Ke", &MaterialDesc::emissionTexture, Srgb},
                           Row{"map_d", &MaterialDesc::opacityTexture, Linear},
                           Row{"map_Bump", &MaterialDesc::bumpMap, Linear},
                           Row{"map_bump", &MaterialDesc::bumpMap, Linear},
                           Row{"bump", &MaterialDesc::bumpMap, Linear},
                           Row{"norm", &MaterialDesc::normalMap, Linear},
                           Row{"map_Kn", &MaterialDesc::normalMap, Linear}}) {
        const std::string line = cat(row.keyword, " a b\\c.ppm # note");
        CHECK_INFO(materialOf(line).*row.texture == 0, row.keyword);
        CHECK_INFO(textureOf(line).space == row.space, row.keyword);
        CHECK_EQUAL(textureOf(line).file, "a b/c.ppm");
    }
    TextureDesc expected;
    expected.name = expected.file = "a.ppm";
    CHECK(textureOf("map_Kd a.ppm") == expected);
    CHECK(textureOf("map_Kd -blendu on -blendv off -mm 0 1 -boost 2 -texres 512 -t 1 1 1 -cc on "
                    "-imfchan l -type sphere -clamp off a.ppm") == expected);
    expected.scale = {2, -3};
    expected.offset = {0.5, 0.25};
    expected.extension = TextureDesc::Extension::Extend;
    CHECK(textureOf("map_Kd -clamp on -o 0.5 0.25 -s 2 -3 1 a.ppm") == expected);
    CHECK((textureOf("map_Kd -s 4 a.ppm").scale == Vec2d{4, 1}));
    CHECK_EQUAL(textureOf("map_Kd -s 1 1 1 2 tiles.ppm").file, "2 tiles.ppm");
    CHECK_EQUAL(textureOf("map_Kd -unknown a.ppm").file, "-unknown a.ppm");
    CHECK_EQUAL(materialOf("map_Bump -bm -2 a.ppm").bumpStrength, -2.0);
    // Equal ones are one, others have names of their own.
    const Result file = readText("newmtl a\nmap_Kd x.ppm\nmap_Ks x.ppm\nnewmtl b\nmap_Kd x.ppm\n"
                                 "bump x.ppm\nmap_d x.ppm\nnorm -s 2 2 x.ppm\n");
    CHECK_EQUAL(file.textures.size(), std::size_t{3});
    CHECK_EQUAL(file.textures[2].name, "x.ppm.3");
    CHECK(file.materials[0].specularTexture == 0 && file.materials[1].diffuseTexture == 0);
    CHECK(file.materials[1].opacityTexture == 1 && file.materials[1].normalMap == 2);
}

TEST(read_mtl_warnings) {
    const Result file = readText("newmtl a\nKd 1 0 0\ndisp a.ppm\nnewmtl b\nKd spectral x.rfl\n"
                                 "newmtl a\nKd 0 1 0\nillum 12\n");
    CHECK_EQUAL(file.materials.size(), std::size_t{3});
    CHECK_EQUAL(file.warnings.size(), std::size_t{2});
    CHECK(file.warnings[0].find("t.mtl:3:1: warning: statements without effect (3 times") == 0);
    CHECK(file.warnings[1].find("t.mtl:6:1: warning: this material's name was given already") == 0);
    checkColour(file.materials[1].diffuse, {0.8, 0.8, 0.8});
}

TEST(read_mtl_random_damage_and_cut_off) {
    const std::string whole = contentOf("tests/scenes/obj/room.mtl");
    std::size_t read = 0, refused = 0;
    const auto checkText = [&](const std::string& text, const std::string& what) {
        try {
            const MtlFile file = readText(text);
            ++read;
            for (const MaterialDesc& m : file.materials)
                for (const Handle h : {m.diffuseTexture, m.bumpMap})
                    CHECK_INFO(h >= kNone && h < static_cast<Handle>(file.textures.size()), what);
        } catch (const Error&) {
            ++refused;
        } catch (const std::exception& error) {
            CHECK_INFO(false, what << " threw " << error.what());
        }
    };
    for (std::size_t size = 0; size < whole.size(); ++size)
        checkText(whole.substr(0, size), cat("cut off at ", size));
    const std::vector<std::string> pieces = {"newmtl ",
                                             "Kd ",
                                             "-s ",
                                             "\\\n",
                                             "\n",
                                             "#",
                                             "nan",
                                             "1e999",
                                             "-1",
                                             "\xff",
                                             "map_d ",
                                             "\r\n",
                                             std::string(1, '\0')};
    for (std::uint32_t seed = 0; seed < check::scaled(2000u); ++seed)
        checkText(damage::damaged(whole, pieces, seed), cat("seed ", seed));
    CHECK_INFO(read > 300 && refused > 300, "read " << read << ", refused " << refused);
}

} // namespace test_read_mtl
