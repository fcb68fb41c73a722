// The PLY reader: ascii and both binary orders give the same mesh, bit for bit. What it refuses is
// in test_ply_damage.cpp.
#include "unit/damage.h"
#include "unit/ply_kit.h"

#include <fstream>
#include <limits>
#include <random>
#include <sstream>

namespace test_read_ply {

using namespace ply_kit;
using damage::contentOf;

TEST(read_ply_triangle) {
    const MeshDesc mesh =
        readAll("element vertex 3\n" + kXyz + "element face 1\n" + kFaces, [](Body& body) {
            body.row("float", {0, 0, 0.5}).row("float", {1, 0, 0}).row("float", {0, -1e-3, 1e20});
            body.list("uchar", "int", {2, 0, 1});
        });
    CHECK_EQUAL(mesh.points.size(), std::size_t{3});
    // Floats stay floats: 0.001 of an ascii file is the float next to it, too.
    CHECK((mesh.points[2] == Vec3d{0, static_cast<double>(-1e-3f), static_cast<double>(1e20f)}));
    CHECK((mesh.triangles == std::vector<MeshDesc::Corners>{{2, 0, 1}}));
    CHECK(mesh.normals.empty() && mesh.uvs.empty() && mesh.name.empty());
}

// A house with a concave front, normals, texture coordinates and things to skip.
TEST(read_ply_files) {
    const MeshDesc mesh = readQuietly(contentOf(kFiles[0]));
    CHECK_EQUAL(mesh.points.size(), std::size_t{10});
    CHECK_EQUAL(mesh.triangles.size(), std::size_t{16}); // 2 (V - 2): closed
    CHECK(mesh.normalTriangles == mesh.triangles && mesh.uvTriangles == mesh.triangles);
    Vec3d area{};
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
        area += cross(q - p, r - p);
        volume += dot(cross(p, q), r) / 6;
    }
    CHECK_NEAR(maxAbs(area), 0, 1e-15);
    CHECK_NEAR(volume, 3, 1e-15); // front of 2 x 2 less its notch of 0.5, two deep
    for (std::size_t i = 1; i < kFiles.size(); ++i)
        CHECK_INFO(readQuietly(contentOf(kFiles[i])) == mesh, kFiles[i]);
}

TEST(read_ply_every_type) {
    for (const std::string type :
         {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"}) {
        const bool isSigned = type[0] != 'u';
        const double low = isSigned ? -100 : 100;
        const std::string xyz =
            replacedAll(kXyz, "float", type); // and the whole ones as counts and indices
        const bool isWhole = type != "float" && type != "double";
        const std::string index = isWhole ? type : "int";
        const MeshDesc mesh =
            readAll(cat("element vertex 3\n", xyz, "element face 1\nproperty list ", index, " ",
                        index, " vertex_index\n"),
                    [&](Body& body) {
                        body.row(type, {0, 0, low}).row(type, {127, 0, 0}).row(type, {0, 5, 0});
                        body.list(index, index, {0, 1, 2});
                    });
        CHECK_INFO((mesh.points[0] == Vec3d{0, 0, low} && mesh.points[1] == Vec3d{127, 0, 0}),
                   type);
        CHECK_INFO((mesh.triangles == std::vector<MeshDesc::Corners>{{0, 1, 2}}), type);
    }
    // Doubles keep all their digits, and the largest numbers of the whole types are right.
    const MeshDesc mesh =
        readAll("element vertex 3\nproperty double x\nproperty uint y\nproperty ushort z\n"
                "element face 1\nproperty list ushort uint vertex_indices\n",
                [](Body& body) {
                    body.put("double", 0.1).put("uint", 4294967295.0).put("ushort", 65535).end();
                    body.put("double", 1e60).put("uint", 1).put("ushort", 2).end();
                    body.put("double", -1e-300).put("uint", 1).put("ushort", 3).end();
                    body.list("ushort", "uint", {0, 1, 2});
                });
    CHECK((mesh.points[0] == Vec3d{0.1, 4294967295.0, 65535}));
    CHECK((mesh.points[1].x == 1e60 && mesh.points[2].x == -1e-300));
}

// The other set of type names means the same.
TEST(read_ply_type_names) {
    const std::array<std::pair<const char*, const char*>, 8> kNames{{{"char", "int8"},
                                                                     {"uchar", "uint8"},
                                                                     {"short", "int16"},
                                                                     {"ushort", "uint16"},
                                                                     {"int", "int32"},
                                                                     {"uint", "uint32"},
                                                                     {"float", "float32"},
                                                                     {"double", "float64"}}};
    for (const auto& [old, sized] : kNames) {
        const auto typeOf = [&](const char* name) {
            const SourceFile file{
                "t.ply", header(PlyFormat::Ascii, cat("element e 1\nproperty ", name, " p\n"))};
            return readPlyHeader(file).elements.at(0).properties.at(0).type;
        };
        CHECK_INFO(typeOf(old) == typeOf(sized), old);
        CHECK_INFO(sizeOf(typeOf(old)) * 8 ==
                       static_cast<std::size_t>(std::stoi(std::string(sized).substr(
                           std::string(sized).find_first_of("0123456789")))),
                   old);
    }
}

TEST(read_ply_normals_and_uvs) {
    for (const auto& [u, v] :
         {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v"),
          std::pair("texture_s", "texture_t")}) {
        const MeshDesc mesh = readAll(
            cat("element vertex 3\nproperty float nz\nproperty float z\nproperty uchar red\n",
                "property float ", v, "\nproperty float x\nproperty float nx\nproperty float y\n",
                "property double ny\nproperty float ", u, "\nelement face 1\n", kFaces),
            [](Body& body) {
                for (int i = 0; i < 3; ++i) {
                    body.put("float", 0.6).put("float", i * i).put("uchar", 255);
                    body.put("float", 0.25 * i).put("float", i).put("float", -0.5);
                    body.put("float", 7).put("double", 0.1).put("float", 0.75).end();
                }
                body.list("uchar", "int", {0, 1, 2});
            });
        CHECK_INFO((mesh.points.at(2) == Vec3d{2, 7, 4}), u);
        CHECK_INFO((mesh.normals.at(1) == Vec3{-0.5f, 0.1f, 0.6f}), u);
        CHECK_INFO((mesh.uvs.at(2) == Vec2{0.75f, 0.5f}), u);
        CHECK(mesh.normalTriangles == mesh.triangles && mesh.uvTriangles == mesh.triangles);
    }
    // A pair or triple counts only when it is complete; of two pairs the first.
    const auto write = [](Body& body) {
        for (int i = 0; i < 3; ++i) body.row("float", {1.0 * i, 1.0 * i * i, 0, 1, 2, 3, 4, 5});
        body.list("uchar", "int", {0, 1, 2});
    };
    const auto with = [&](const std::string& names) {
        std::string lines = "element vertex 3\n" + kXyz;
        std::istringstream in(names);
        for (std::string name; in >> name;) lines += "property float " + name + "\n";
        return readAll(lines + "element face 1\n" + kFaces, write);
    };
    CHECK(with("nx ny s u texture_v").normals.empty() && with("nx ny s u texture_v").uvs.empty());
    CHECK((with("u v s t nx").uvs.at(0) == Vec2{3, 4}));
    CHECK((with("s t u v nx").uvs.at(0) == Vec2{1, 2}));
}

TEST(read_ply_skips_what_it_does_not_know) {
    const MeshDesc mesh = readAll(
        "comment element vertex 99\nobj_info made by hand\n"
        "element camera 2\nproperty double view\nproperty list short double knots\n"
        "element nothing 5\n"
        "element vertex 3\nproperty list uchar uchar labels\n" +
            kXyz +
            "property uchar red\n"
            "element edge 2\nproperty int a\nproperty int b\n"
            "element face 2\nproperty uchar flags\nproperty list int float texcoord\n" +
            kFaces +
            "property double quality\n"
            "element tail 1\nproperty list uint short words\n",
        [](Body& body) {
            body.put("double", 5).list("short", "double", {1, 2, 3});
            body.put("double", 6).put("short", 0).end();
            for (int i = 0; i < 3; ++i) {
                body.put("uchar", i);
                for (int k = 0; k < i; ++k) body.put("uchar", 9);
                body.put("float", i).put("float", i * i).put("float", 0).put("uchar", 200).end();
            }
            body.row("int", {0, 1}).row("int", {1, 2});
            for (int i = 0; i < 2; ++i) {
                body.put("uchar", 1).put("int", 2).put("float", 0.5).put("float", 0.25);
                body.put("uchar", 3).put("int", i).put("int", 1 - i).put("int", 2);
                body.put("double", 0.5).end();
            }
            body.list("uint", "short", {1, 2, 3, 4});
        });
    CHECK((mesh.points.at(2) == Vec3d{2, 4, 0}));
    CHECK((mesh.triangles == std::vector<MeshDesc::Corners>{{0, 1, 2}, {1, 0, 2}}));
}

TEST(read_ply_polygons) {
    const MeshDesc mesh =
        readAll("element vertex 7\n" + kXyz + "element face 3\n" + kFaces, [](Body& body) {
            // A chevron whose notch is vertex 3, and two that make a square.
            body.row("float", {0, 0, 0}).row("float", {2, 0, 0}).row("float", {2, 1, 0});
            body.row("float", {1, 0.5, 0}).row("float", {0, 1, 0});
            body.row("float", {2, 3, 0}).row("float", {0, 3, 0});
            body.list("uchar", "int", {0, 1, 2, 3, 4});
            body.list("uchar", "int", {4, 2, 5, 6});
            body.list("uchar", "int", {4, 3, 2});
        });
    CHECK_EQUAL(mesh.triangles.size(), std::size_t{6});
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d n = cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
        CHECK(n.z > 0);
        area += n.z / 2;
    }
    CHECK_NEAR(area, 6, 1e-15);
    CHECK((mesh.triangles[5] == MeshDesc::Corners{4, 3, 2})); // in the order of the file
}

// Two strips in one list, with a repeated corner to turn.
TEST(read_ply_strips) {
    const MeshDesc mesh = readAll("element vertex 6\n" + kXyz +
                                      "element tristrips 1\n"
                                      "property list int int vertex_indices\n",
                                  [](Body& body) {
                                      for (int i = 0; i < 6; ++i)
                                          body.row("float", {1.0 * i, 1.0 * i * i, 0});
                                      body.list("int", "int", {0, 1, 2, 3, -1, 2, 3, 3, 4, 5});
                                  });
    CHECK((mesh.triangles == std::vector<MeshDesc::Corners>{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}}));
}

TEST(read_ply_leaves_out_what_shows_nothing) {
    for (const PlyFormat format : kFormats) {
        Body body(format);
        body.row("float", {9, 9, 9});
        for (int i = 0; i < 4; ++i)
            body.row("float", {
                                  1.0 * i,
                                  1.0 * i * i,
                                  0,
                              });
        body.list("uchar", "int", {1, 2, 3}).list("uchar", "int", {1, 2, 1});
        body.put("uchar", 0).end().list("uchar", "int", {2}).list("uchar", "int", {2, 3});
        body.list("uchar", "int", {4, 4, 4, 4}).list("uchar", "int", {3, 2, 4});
        const Reading read =
            readWhole(header(format, "element vertex 5\n" + kXyz + "element face 7\n" + kFaces) +
                      body.text());
        CHECK((read.mesh.triangles == std::vector<MeshDesc::Corners>{{0, 1, 2}, {2, 1, 3}}));
        CHECK_EQUAL(read.mesh.points.size(), std::size_t{4});
        CHECK((read.mesh.points.at(3) == Vec3d{3, 9, 0}));
        const std::string all = join(read.warnings);
        CHECK_EQUAL(read.warnings.size(), std::size_t{2});
        CHECK_INFO(all.find("t.ply:7:1: warning: left out 5 of 7 faces, with fewer than three "
                            "different corners; the first is face 1") != std::string::npos,
                   all);
        CHECK_INFO(all.find("t.ply:3:1: warning: left out 1 of 5 vertices, which no face uses") !=
                       std::string::npos,
                   all);
    }
}

// Windows' line ends in the header, and in ascii data everywhere.
TEST(read_ply_line_ends) {
    const MeshDesc mesh = readQuietly(contentOf(kFiles[0]));
    const std::string ascii = contentOf(kFiles[0]);
    CHECK(readQuietly(replacedAll(ascii, "\n", "\r\n")) == mesh);
    CHECK(readQuietly(replacedAll(ascii, " ", "\t")) == mesh);
    CHECK(readQuietly(replacedAll(ascii, " ", "   ")) == mesh);
    CHECK(readQuietly(ascii.substr(0, ascii.size() - 1)) == mesh);
    CHECK(readQuietly(ascii + "\n \r\n") == mesh);
    const std::size_t data = ascii.find("end_header\n") + 11;
    CHECK(readQuietly(ascii.substr(0, data) + replacedAll(ascii.substr(data), "\n", "\n\n")) ==
          mesh);
    for (const char* name : {kFiles[1], kFiles[2]}) {
        const std::string text = contentOf(name);
        const std::size_t dataOfIt = text.find("end_header\n") + 11;
        CHECK(readQuietly(replacedAll(text.substr(0, dataOfIt), "\n", "\r\n") +
                          text.substr(dataOfIt)) == mesh);
    }
}

TEST(read_ply_rest_of_the_file) {
    const Reading ascii = readWhole(contentOf(kFiles[0]) + "\n1 2 3\n");
    CHECK_EQUAL(ascii.warnings.size(), std::size_t{2}); // and of what no picture shows
    CHECK_INFO(ascii.warnings.at(0).find(": warning: this follows the last element") !=
                   std::string::npos,
               ascii.warnings[0]);
    const Reading binary = readWhole(contentOf(kFiles[1]) + "12345");
    CHECK_EQUAL(binary.warnings.size(), std::size_t{2});
    CHECK_INFO(binary.warnings.at(0).find("5 bytes follow the last element") != std::string::npos,
               binary.warnings[0]);
}

} // namespace test_read_ply
