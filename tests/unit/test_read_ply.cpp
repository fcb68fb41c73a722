// The PLY reader: ascii and both binary orders give the same mesh, bit for bit. What it refuses is
// in tests/bad/ply (test_bad_scenes.cpp) and, for binary data, here.
#include "read/mesh/read_ply.h"

#include "base/text.h"
#include "check.h"
#include "read/mesh/ply_header.h"
#include "unit/damage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

namespace {

using damage::contentOf;

constexpr std::array kFormats{PlyFormat::Ascii, PlyFormat::LittleEndian, PlyFormat::BigEndian};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Writes the data of a file in any format: the test's own idea of what the bytes are.
class Body {
public:
    explicit Body(PlyFormat format) : format_(format) {}

    // type: a name of the header
    Body& put(std::string_view type, double value) {
        if (format_ == PlyFormat::Ascii) {
            data_ += value == static_cast<double>(static_cast<float>(value))
                         ? cat(shortest(static_cast<float>(value)), " ")
                         : cat(shortest(value), " ");
            return *this;
        }
        std::array<char, 8> bytes{};
        std::size_t size = 0;
        const auto keep = [&](auto number) {
            std::memcpy(bytes.data(), &number, size = sizeof number);
        };
        if (type == "char") keep(static_cast<std::int8_t>(value));
        if (type == "uchar") keep(static_cast<std::uint8_t>(value));
        if (type == "short") keep(static_cast<std::int16_t>(value));
        if (type == "ushort") keep(static_cast<std::uint16_t>(value));
        if (type == "int") keep(static_cast<std::int32_t>(value));
        if (type == "uint") keep(static_cast<std::uint32_t>(value));
        if (type == "float") keep(static_cast<float>(value));
        if (type == "double") keep(value);
        CHECK_INFO(size > 0, type);
        const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(size);
        if ((std::endian::native == std::endian::big) != (format_ == PlyFormat::BigEndian))
            std::reverse(bytes.begin(), end);
        data_.append(bytes.begin(), end);
        return *this;
    }
    Body& row(std::string_view type, std::initializer_list<double> values) {
        for (const double value : values) put(type, value);
        return end();
    }
    // A list and the end of its row.
    Body& list(std::string_view countType, std::string_view type,
               std::initializer_list<double> values) {
        put(countType, static_cast<double>(values.size()));
        return row(type, values);
    }
    Body& end() {
        if (format_ == PlyFormat::Ascii) data_.back() = '\n';
        return *this;
    }
    const std::string& text() const { return data_; }

private:
    PlyFormat format_;
    std::string data_;
};

std::string header(PlyFormat format, const std::string& lines) {
    return cat("ply\nformat ", nameOf(format), " 1.0\n", lines, "end_header\n");
}
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

struct Read {
    MeshDesc mesh;
    std::vector<std::string> warnings;
};
Read readWhole(const std::string& text) {
    Diagnostics diagnostics;
    MeshFile file = readPly({"t.ply", text}, {{}, diagnostics});
    CHECK(file.parts.empty() && file.materials.empty() && file.libraries.empty());
    return {std::move(file.mesh), std::move(diagnostics.warnings)};
}
MeshDesc readQuietly(const std::string& text) {
    Read read = readWhole(text);
    CHECK_INFO(read.warnings.empty(), join(read.warnings));
    return std::move(read.mesh);
}
std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}
// The same file in each format; write(body) puts the data.
template <class Write> MeshDesc readAll(const std::string& lines, const Write& write) {
    std::vector<MeshDesc> meshes;
    for (const PlyFormat format : kFormats) {
        Body body(format);
        write(body);
        meshes.push_back(readQuietly(header(format, lines) + body.text()));
        CHECK_INFO(meshes.back() == meshes.front(), nameOf(format));
    }
    return meshes.front();
}
std::string failureOf(const std::string& text) {
    return check::thrown([&] { readWhole(text); });
}
const std::array kFiles{"tests/scenes/ply/house_ascii.ply", "tests/scenes/ply/house_little.ply",
                        "tests/scenes/ply/house_big.ply"};

} // namespace

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
        const Read read =
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
    const Read ascii = readWhole(contentOf(kFiles[0]) + "\n1 2 3\n");
    CHECK_EQUAL(ascii.warnings.size(), std::size_t{1});
    CHECK_INFO(ascii.warnings.at(0).find(": warning: this follows the last element") !=
                   std::string::npos,
               ascii.warnings[0]);
    const Read binary = readWhole(contentOf(kFiles[1]) + "12345");
    CHECK_EQUAL(binary.warnings.size(), std::size_t{1});
    CHECK_INFO(binary.warnings.at(0).find("5 bytes follow the last element") != std::string::npos,
               binary.warnings[0]);
}

// A small file that promises a thousand million vertices fails before memory is asked for.
TEST(read_ply_counts_are_checked_first) {
    for (const PlyFormat format : kFormats)
        for (const char* lines :
             {"element vertex 1000000000\n", "element vertex 4294967295\n", "element vertex 9\n"}) {
            const auto start = std::chrono::steady_clock::now();
            const std::string message = failureOf(
                header(format, lines + kXyz + "element face 1\n" + kFaces) + "0 0 0 0 0 0\n");
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
            const std::size_t rowBytes = format == PlyFormat::Ascii ? 6 : 12;
            CHECK_INFO(message.starts_with("t.ply:3:1: error: 'element vertex ") &&
                           message.find(cat("' is more than the rest of the file can hold (",
                                            12 / rowBytes, " at most)")) != std::string::npos,
                       message);
            CHECK(seconds.count() < 0.1); // a few microseconds; memory of 24 GB takes seconds
        }
    // Counts of lists, too.
    for (const PlyFormat format : {PlyFormat::LittleEndian, PlyFormat::BigEndian}) {
        Body body(format);
        body.row("float", {0, 0, 0}).put("uint", 4000000000.0).put("uchar", 0);
        const std::string lines = "element vertex 1\n" + kXyz + "element ";
        CHECK_THROWS(readWhole(header(format, lines + "face 1\nproperty list uint int "
                                                      "vertex_indices\n") +
                               body.text()),
                     "a list of 'vertex_indices' has 4000000000 items; at most 0 fit into");
        CHECK_THROWS(readWhole(header(format, lines + "tristrips 1\nproperty list uint int "
                                                      "vertex_indices\n") +
                               body.text()),
                     "a list of 'vertex_indices' has 4000000000 items; at most");
        CHECK_THROWS(
            readWhole(header(format, lines + "face 1\nproperty list uint int other\n" + kFaces) +
                      body.text()),
            "a list of 'other' has 4000000000 items; at most 0 fit into the rest of the file");
    }
}

// The place in binary data is a byte and a row; the line is that of the element.
TEST(read_ply_places_in_binary_data) {
    const std::string lines = "element vertex 3\n" + kXyz + "element face 2\n" + kFaces;
    for (const PlyFormat format : {PlyFormat::LittleEndian, PlyFormat::BigEndian}) {
        const std::size_t data = header(format, lines).size();
        const auto failure = [&](double z, std::initializer_list<double> face) {
            Body body(format);
            body.row("float", {0, 0, 0}).row("float", {1, 0, z}).row("float", {0, 1, 0});
            body.list("uchar", "int", {0, 1, 2}).list("uchar", "int", face);
            return failureOf(header(format, lines) + body.text());
        };
        CHECK_EQUAL(failure(0, {0, 1, 2}), "");
        CHECK_INFO(failure(kNan, {0, 1, 2})
                       .starts_with(cat("t.ply:3:1: error: byte ", data + 20,
                                        ", row 1 of 'vertex': 'z' is not a finite number")),
                   failure(kNan, {0, 1, 2}));
        for (const auto& [index, text] :
             {std::pair(3.0, "3"), {-1.0, "-1"}, {-2147483648.0, "-2147483648"}})
            CHECK_INFO(failure(0, {2, index, 1})
                           .starts_with(cat("t.ply:7:1: error: byte ", data + 36 + 13 + 5,
                                            ", row 1 of 'face': there is no vertex ", text,
                                            "; the file has 3, counted from 0")),
                       failure(0, {2, index, 1}));
    }
}

namespace {

void readSound(const std::string& text) {
    const MeshDesc mesh = readWhole(text).mesh;
    CHECK(!mesh.triangles.empty());
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t corner : t) CHECK(corner < mesh.points.size());
    for (const Vec3d& p : mesh.points) CHECK(maxAbs(p) <= 1e60 && p == p);
    CHECK(mesh.normals.empty() || mesh.normals.size() == mesh.points.size());
    CHECK(mesh.uvs.empty() || mesh.uvs.size() == mesh.points.size());
}

} // namespace

TEST(read_ply_cut_off_at_every_byte) {
    for (const char* name : kFiles) {
        const std::string whole = contentOf(name);
        readSound(whole);
        std::size_t read = 0;
        for (std::size_t size = 0; size < whole.size(); ++size)
            if (damage::isRead([&] { readSound(whole.substr(0, size)); })) ++read;
        // Ascii may lose its last line end and three digits of its last number, 0.25.
        CHECK_INFO(read <= (name == kFiles[0] ? 4u : 0u), name << " was read " << read << " times");
    }
}

TEST(read_ply_random_damage) {
    const std::vector<std::string> pieces = {"\n",
                                             "\r\n",
                                             " ",
                                             "-1",
                                             "nan",
                                             "1e999",
                                             "0",
                                             "4294967295",
                                             "element ",
                                             "3 ",
                                             "uchar ",
                                             "double ",
                                             "list ",
                                             "int ",
                                             "property uchar ",
                                             "end_header\n",
                                             std::string(1, '\0'),
                                             "\xff\xff\xff\xff",
                                             "\x7f\x80",
                                             "99999999"};
    for (const char* name : kFiles) {
        const std::string whole = contentOf(name);
        const auto [read, refused] = damage::inflict(
            whole, pieces, 4000, [](const std::string& text, std::uint32_t) { readSound(text); });
        // Both must happen, or the test tests nothing.
        CHECK_INFO(read > 300 && refused > 1000,
                   name << ": read " << read << ", refused " << refused);
    }
}
