// PLY files as other programs write them: faces in front of their vertices, texture coordinates of
// corners, numbers that are not finite, and what is said of all that a picture does not show.
#include "unit/ply_kit.h"

#include <cmath>
#include <limits>

namespace test_ply_faces {

using namespace ply_kit;

namespace {

using Triangles = std::vector<MeshDesc::Corners>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A file in each format, its warnings joined.
struct Said {
    MeshDesc mesh;
    std::string warnings;
};
template <class Write>
std::vector<Said> inAllFormats(const std::string& lines, const Write& write) {
    std::vector<Said> out;
    for (const PlyFormat format : kFormats) {
        Body body(format);
        write(body);
        Reading read = readWhole(header(format, lines) + body.text());
        out.push_back({std::move(read.mesh), join(read.warnings, "\n")});
        CHECK_INFO(out.back().mesh == out.front().mesh, nameOf(format));
    }
    return out;
}
bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}
void putSquare(Body& body) {
    body.row("float", {0, 0, 0}).row("float", {1, 0, 0});
    body.row("float", {1, 1, 0}).row("float", {0, 1, 0});
}

} // namespace

TEST(ply_faces_before_vertices) {
    const std::string faces = "element face 2\n" + kFaces,
                      strips = "element tristrips 1\n" + kFaces,
                      vertices = "element vertex 4\n" + kXyz,
                      edge = "element edge 1\nproperty int a\n";
    const auto putFaces = [](Body& body) {
        body.list("uchar", "int", {0, 1, 2}).list("uchar", "int", {0, 2, 3});
    };
    const MeshDesc usual = readAll(vertices + faces, [&](Body& body) {
        putSquare(body);
        putFaces(body);
    });
    const MeshDesc first = readAll(faces + edge + vertices, [&](Body& body) {
        putFaces(body);
        body.row("int", {7});
        putSquare(body);
    });
    CHECK(first == usual);
    CHECK((first.triangles == Triangles{{0, 1, 2}, {0, 2, 3}}));
    const MeshDesc strip = readAll(strips + vertices, [&](Body& body) {
        body.list("uchar", "int", {0, 1, 3, 2});
        putSquare(body);
    });
    CHECK((strip.triangles == Triangles{{0, 1, 3}, {3, 1, 2}}));
    // What is wrong with them is told when the vertices are known.
    CHECK(has(failureOf(header(PlyFormat::Ascii, faces + vertices) +
                        "3 0 1 2\n3 0 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"),
              ":11:7: error: there is no vertex 4"));
    CHECK(has(failureOf(header(PlyFormat::Ascii, faces + vertices) + "3 0 1 2\n3 0 1 2\n"),
              "'element vertex 4' is more than the rest of the file can hold"));
}

TEST(ply_texture_coordinates_of_corners) {
    const std::string lines = "element vertex 4\n" + kXyz +
                              "element face 2\nproperty list uchar float texcoord\n"
                              "property int texnumber\n" +
                              kFaces;
    const auto write = [](double picture, bool secondFits) {
        return [=](Body& body) {
            putSquare(body);
            body.put("uchar", 6);
            for (const double uv : {0.0, 0.0, 0.5, 0.0, 0.5, 0.25}) body.put("float", uv);
            body.put("int", 0).list("uchar", "int", {0, 1, 2});
            body.put("uchar", secondFits ? 8 : 2);
            for (int i = 0; i < (secondFits ? 8 : 2); ++i) body.put("float", 0.125 * i);
            body.put("int", picture).list("uchar", "int", {0, 1, 2, 3});
        };
    };
    const std::vector<Said> all = inAllFormats(lines, write(0, true));
    const MeshDesc& mesh = all.front().mesh;
    CHECK_INFO(all.front().warnings.empty(), all.front().warnings);
    CHECK((mesh.triangles == Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
    CHECK((mesh.uvTriangles == Triangles{{0, 1, 2}, {3, 4, 5}, {3, 5, 6}}));
    CHECK_EQUAL(mesh.uvs.size(), std::size_t{7});
    CHECK((mesh.uvs.at(2) == Vec2{0.5f, 0.25f} && mesh.uvs.at(6) == Vec2{0.75f, 0.875f}));
    // Two pictures, and a face that has no coordinates.
    const std::vector<Said> odd = inAllFormats(lines, write(1, false));
    CHECK((odd.front().mesh.uvs.at(5) == Vec2{}));
    for (const Said& said : odd) {
        CHECK_INFO(has(said.warnings, "1 face has no texture coordinates"), said.warnings);
        CHECK_INFO(has(said.warnings, "are of 2 pictures"), said.warnings);
    }
}

// Those of vertices hold where some faces have none of their own.
TEST(ply_texture_coordinates_of_vertices_and_corners) {
    const std::string lines = "element vertex 3\n" + kXyz +
                              "property float s\nproperty float t\nelement face 1\n" + kFaces +
                              "property list uchar float texcoord\n";
    const auto write = [](std::size_t count) {
        return [=](Body& body) {
            for (int i = 0; i < 3; ++i) body.row("float", {i * 1.0, i * i * 1.0, 0, 0.5 * i, 1});
            body.put("uchar", 3).put("int", 0).put("int", 1).put("int", 2);
            body.put("uchar", static_cast<double>(count));
            for (std::size_t i = 0; i < count; ++i) body.put("float", 0.25);
            body.end();
        };
    };
    const Said corners = inAllFormats(lines, write(6)).front(),
               vertices = inAllFormats(lines, write(0)).front();
    CHECK((corners.mesh.uvs == RawVector<Vec2>(3, Vec2{0.25f, 0.25f})));
    CHECK_INFO(has(corners.warnings, "left out: 'vertex' (s, t)"), corners.warnings);
    CHECK((vertices.mesh.uvs.at(2) == Vec2{1, 1}));
    CHECK(vertices.mesh.uvTriangles == vertices.mesh.triangles);
    CHECK_INFO(has(vertices.warnings, "left out: 'face' (texcoord)"), vertices.warnings);
}

TEST(ply_numbers_that_are_not_finite) {
    const std::string lines = "element vertex 5\n" + kXyz +
                              "property float nx\nproperty float ny\nproperty float nz\n"
                              "property float u\nproperty float v\nelement face 3\n" +
                              kFaces;
    for (const double bad : {kNan, HUGE_VAL, -HUGE_VAL}) {
        const std::vector<Said> all = inAllFormats(lines, [&](Body& body) {
            body.row("float", {0, 0, 0, 0, 0, 1, 0, 0}).row("float", {1, 0, 0, bad, 0, 1, 1, 0});
            body.row("float", {1, 1, 0, 0, 0, 1, bad, 1}).row("float", {0, 1, bad, 0, 0, 1, 0, 1});
            body.row("float", {0, 1, 0, 0, 0, 1, 0, 1}).list("uchar", "int", {0, 1, 2});
            body.list("uchar", "int", {0, 2, 3}).list("uchar", "int", {0, 1, 2, 4});
        });
        for (const Said& said : all) {
            CHECK_INFO(
                has(said.warnings, "3 points, normals or texture coordinates are not finite"),
                said.warnings);
            CHECK_INFO(has(said.warnings, "left out 1 of 3 faces"), said.warnings);
        }
        const MeshDesc& mesh = all.front().mesh;
        CHECK((mesh.triangles == Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
        CHECK((mesh.normals.at(1) == Vec3{} && mesh.normals.at(0) == Vec3{0, 0, 1}));
        CHECK((mesh.uvs.at(2) == Vec2{} && mesh.uvs.at(1) == Vec2{1, 0}));
    }
    // As programs write them; and what nothing reads may be anything.
    for (const char* word : {"nan", "-nan", "NaN", "inf", "-Infinity", "nan(ind)", "1e999"}) {
        const Reading read = readWhole(
            header(PlyFormat::Ascii, "element vertex 4\n" + kXyz + "property float quality\n" +
                                         "element face 1\n" + kFaces) +
            cat("0 0 0 ", word, "\n1 0 0 ", word, "\n0 1 0 1\n0 ", word, " 1 1\n3 0 1 2\n"));
        CHECK_EQUAL(read.mesh.points.size(), std::size_t{3});
        CHECK_INFO(has(join(read.warnings), "1 point, normal or texture coordinate is not finite"),
                   word);
    }
}

// One warning names the file, the elements and their properties.
TEST(ply_names_what_is_left_out) {
    const std::vector<Said> all = inAllFormats(
        "comment TextureFile skin.png\nelement vertex 3\n" + kXyz +
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "element edge 1\nproperty int a\nelement face 1\n" +
            kFaces + "property uchar flags\n",
        [](Body& body) {
            for (int i = 0; i < 3; ++i)
                body.put("float", i).put("float", i * i).put("float", 0).row("uchar", {255, 0, 0});
            body.row("int", {0}).put("uchar", 3).put("int", 0).put("int", 1).put("int", 2);
            body.row("uchar", {1});
        });
    for (const Said& said : all) {
        CHECK_INFO(said.warnings.starts_with(
                       "t.ply:4:1: warning: left out: 'vertex' (red, green, blue), 'edge' (a), "
                       "'face' (flags), the picture 'skin.png' (TextureFile); materials alone give "
                       "colour here"),
                   said.warnings);
        CHECK(said.mesh.uvs.empty());
    }
}

} // namespace test_ply_faces
