// What the PLY reader refuses, and what it makes of damaged files: counts that the file cannot
// hold, places in binary data, files that are cut off or changed. Ascii files with one mistake each
// are in tests/bad/ply (test_bad_scenes.cpp).
#include "unit/damage.h"
#include "unit/ply_kit.h"

#include <chrono>
#include <limits>

namespace test_ply_damage {

using namespace ply_kit;
using damage::contentOf;

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
        CHECK_INFO(failure(std::numeric_limits<double>::quiet_NaN(), {0, 1, 2})
                       .starts_with("t.ply:3:1: error: none of the faces has three different "
                                    "corners, whose numbers are finite"),
                   failure(std::numeric_limits<double>::quiet_NaN(), {0, 1, 2}));
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

} // namespace test_ply_damage
