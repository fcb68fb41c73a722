// The OBJ reader: each statement and quirk with numbers made by hand, and damage. Faces are in
// test_obj_faces.cpp.
#include "read/mesh/mesh_file.h"

#include "base/text.h"
#include "check.h"
#include "unit/damage.h"
#include "unit/obj_kit.h"

#include <chrono>

namespace test_read_obj {

using damage::contentOf;
using obj_kit::Corners;
using obj_kit::kSquare;
using obj_kit::normalAt;
using obj_kit::partsOf;
using obj_kit::readBody;
using obj_kit::readText;
using obj_kit::Result;
using obj_kit::Triangles;
using obj_kit::uvAt;
using obj_kit::warns;

TEST(read_obj_smallest) {
    const Result file = readBody("f 1 2 3\nf 1 3 4");
    CHECK(file.warnings.empty());
    CHECK((file.mesh.points == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    CHECK((file.mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}}));
    CHECK(file.mesh.normals.empty() && file.mesh.uvs.empty());
    CHECK(file.mesh.normalTriangles.empty() && file.mesh.uvTriangles.empty());
    CHECK(file.mesh.triangleMaterials.empty() && file.materials.empty());
    CHECK(file.parts.empty() && file.libraries.empty());
}

TEST(read_obj_room) {
    const std::string text = contentOf("tests/scenes/obj/room.obj");
    const Result file = readText(text);
    CHECK_EQUAL(file.mesh.points.size(), std::size_t{6});
    CHECK((file.mesh.points.at(4) == Vec3d{0, 0, 1}));
    CHECK((file.mesh.triangles ==
           Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}, {0, 1, 2}, {2, 1, 0}}));
    CHECK((file.materials == std::vector<std::string>{"red brick", "glass"}));
    CHECK((file.mesh.triangleMaterials == std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1, 0}));
    CHECK_EQUAL(text.substr(file.materialLocs.at(1).offset, 12), "usemtl glass");
    CHECK_EQUAL(partsOf(file), "house.front@0 house@3 tree@5 ");
    CHECK_EQUAL(text.substr(file.parts.at(2).loc.offset, 6), "o tree");
    CHECK_EQUAL(file.libraries.size(), std::size_t{3});
    CHECK_EQUAL(file.libraries.at(0).file, "room.mtl");
    CHECK_EQUAL(file.libraries.at(1).file, "other/things.MTL");
    CHECK_EQUAL(file.libraries.at(2).file, "last one");
    CHECK_EQUAL(text.substr(file.libraries.at(2).loc.offset, 8), "last one");
    // vt: one number has v = 0; faces without vt have 0 0.
    CHECK((uvAt(file.mesh, 1, 2) == Vec2{0, 0}));
    CHECK((uvAt(file.mesh, 0, 2) == Vec2{1, 1}));
    CHECK((uvAt(file.mesh, 3, 1) == Vec2{0, 0}));
    CHECK((uvAt(file.mesh, 6, 0) == Vec2{1, 1}));
    // As written, not normalised; flat where the face has none, although it is in a file with some.
    CHECK((normalAt(file.mesh, 0, 2) == Vec3{0, 0, 1}));
    CHECK((normalAt(file.mesh, 2, 0) == Vec3{0, 0, -2}));
    CHECK((normalAt(file.mesh, 3, 0) == Vec3{0, 1, 0}));
    CHECK((normalAt(file.mesh, 6, 1) == Vec3{0, 0, -1}));
    CHECK_EQUAL(file.warnings.size(), std::size_t{3});
    CHECK(warns(file, "t.obj:30:1: warning: left out: 1 face with fewer than three corners, 1 face "
                      "without area"));
    CHECK(warns(file, "2 statements of points, lines, curves"));
    CHECK(warns(file, "1 vertex has a colour"));
}

// What nothing needs may be anything; a face does without what is not finite.
TEST(read_obj_numbers_that_are_not_finite) {
    const Result colours = readText("v 0 0 0 nan nan nan\nv 1 0 0 1 -inf 1\nv 0 1 0 1 1 1e999\n"
                                    "f 1 2 3\n");
    CHECK_EQUAL(colours.mesh.triangles.size(), std::size_t{1});
    CHECK_EQUAL(colours.warnings.size(), std::size_t{1});
    CHECK(warns(colours, "t.obj:1:") && warns(colours, "3 vertices have colours"));
    for (const std::string bad :
         {"nan", "-nan", "NaN", "INF", "-Infinity", "nan(ind)", "1e999", "-1e61"}) {
        const Result file = readBody(cat("v 0 ", bad, " 0\nvn 0 0 ", bad, "\nvn 0 0 1\nvt 0 ", bad,
                                         "\nvt 0.5 1\nf 1/2/2 2/1/1 3/2/2\nf 1//2 3//2 4//2\n",
                                         "f 1 2 5\nf 1 2 3 5\n"));
        CHECK_INFO(warns(file, "t.obj:5:2: warning: 3 vertices, normals or texture coordinates are "
                               "not finite or too large; faces do without them; the first is here"),
                   bad << join(file.warnings));
        CHECK(warns(file, "left out: 2 faces without area"));
        CHECK((file.mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}}));
        CHECK_EQUAL(file.mesh.points.size(), std::size_t{4});
        CHECK((normalAt(file.mesh, 0, 1) == Vec3{} && normalAt(file.mesh, 0, 0) == Vec3{0, 0, 1}));
        CHECK((uvAt(file.mesh, 0, 1) == Vec2{} && uvAt(file.mesh, 0, 0) == Vec2{0.5f, 1}));
    }
    CHECK_THROWS(readBody("vn 0 0 nano\nf 1 2 3"), "expected a number after 'vn', got 'nano'");
}

TEST(read_obj_line_ends) {
    const std::string text = contentOf("tests/scenes/obj/room.obj");
    const MeshFile file = readText(text);
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string out = text;
        out.replace(out.find("\\\n"), 2, " "); // joined lines come below
        for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
            out.replace(at, from.size(), to);
        return out;
    };
    const auto same = [&](const std::string& other) {
        const Result again = readText(other);
        CHECK(again.mesh == file.mesh && again.materials == file.materials &&
              partsOf(again) == partsOf(file) && again.libraries.size() == file.libraries.size());
    };
    same(replaced("\n", "\r\n"));
    same(replaced("\n", "\n\n  \t\n"));
    same(replaced("\n", " \t\n\t "));
    same(replaced("\nf ", "\n# f 9 9 9 \\\nf ")); // a comment joins no line
    same("\xef\xbb\xbf" + text);
    same(text.substr(0, text.size() - 1));
    // Every blank may be the end of a joined line.
    const Result joined = readBody("\\\nf\\\n 1\\\r\n2 \\\n 3\\\n\nf 1 3 4\\\n");
    CHECK((joined.mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}}));
    // Not so in a comment, and what looks like a statement there is none.
    CHECK_EQUAL(readBody("f 1 2 3 # \\\nf 1 3 4\n").mesh.triangles.size(), std::size_t{2});
    CHECK_EQUAL(readBody("x \\\nf 1 3 4\nf 1 2 3\n").mesh.triangles.size(), std::size_t{1});
    CHECK_EQUAL(readBody("f 1 2 3#x").mesh.triangles.size(), std::size_t{1});
}

TEST(read_obj_numbers) {
    // Positions are doubles, to the last bit; normals and uvs floats.
    const Result file = readText("v 0.1 -1e60 +3.5E-2\nv 1. .5 0\nv 0.30000000000000004 0 0 1 .5 "
                                 "0 1\nvn 0.1 0 1\nvt -.25 16777217\nf 1/1/1 2/1/1 3/1/1");
    CHECK((file.mesh.points ==
           std::vector<Vec3d>{{0.1, -1e60, 0.035}, {1, 0.5, 0}, {0.1 + 0.2, 0, 0}}));
    CHECK((file.mesh.normals == std::vector<Vec3>{{0.1f, 0, 1}}));
    CHECK((file.mesh.uvs == std::vector<Vec2>{{-0.25f, 16777216}}));
    CHECK((file.mesh.uvTriangles == Triangles{{0, 0, 0}}));
}

TEST(read_obj_unknown_statements) {
    const Result file = readBody("vx 1 2 3\np 1 2\nfoo\nvp 1\nf 1 2 3 4\nbar \\\n f 1 2 3\n");
    CHECK_EQUAL(file.mesh.triangles.size(), std::size_t{2});
    CHECK(warns(file, "t.obj:5:1: warning: 3 unknown statements left out"));
    CHECK(warns(file, "t.obj:6:1: warning: 2 statements of points, lines"));
}

// A picture needs no more of a corner than its point.
TEST(read_obj_numbers_that_are_not_there) {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    const Result none = readText(points + "f 1//1 2//1 3//1\nf 1/7/2 3/8/2 4/9/2\n");
    CHECK_EQUAL(none.mesh.triangles.size(), std::size_t{2});
    CHECK(none.mesh.normals.empty() && none.mesh.uvs.empty());
    CHECK_EQUAL(none.warnings.size(), std::size_t{1});
    CHECK(none.warnings[0].find("t.obj:5:2: warning: 2 faces have texture coordinates or normals "
                                "that are not in the file") == 0);
    // One of a face is enough to leave out those of its kind; other faces keep theirs.
    const Result some = readText(points + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/4\nf 1/1 3/3 4/2\n");
    CHECK_EQUAL(some.mesh.triangles.size(), std::size_t{2});
    CHECK_EQUAL(some.mesh.uvs.size(), std::size_t{4}); // 0 0 for corners without
    CHECK_EQUAL(some.warnings.size(), std::size_t{1});
    CHECK_THROWS(readText(points + "f 1 2 5\n"), "there is no vertex 5; the file has 4 vertices");
    CHECK_THROWS(readText(points + "f 1/0 2/1 3/1\n"), "there is no index 0");
}

TEST(read_obj_parts_and_materials) {
    // Faces before the first name; empty parts go; the same name again goes on with its part.
    const Result file =
        readBody("f 1 2 3\ng a\ng b\nf 1 2 3\nusemtl x\ng b\nf 1 2 3\nf 1 1 1\no c\n"
                 "usemtl never\nusemtl y\nf 1 2 3\ng  d   e \nusemtl x#1\nf 1 2 3\n");
    CHECK_EQUAL(partsOf(file), "@0 b@1 c@3 c.d   e@4 ");
    CHECK((file.materials == std::vector<std::string>{"", "x", "y", "x#1"}));
    CHECK((file.mesh.triangleMaterials == std::vector<std::uint32_t>{0, 0, 1, 2, 3}));
    // One material for all needs no list; a part that has no face with an area is none.
    const Result one = readBody("usemtl x\ng a\nf 1 1 1\ng b\nf 1 2 3\n");
    CHECK(one.mesh.triangleMaterials.empty() && one.materials.size() == 1);
    CHECK_EQUAL(partsOf(one), "b@0 ");
    CHECK_EQUAL(partsOf(readBody("g a\nf 1 2 3\ng b\nf 1 1 1\ng a\nf 1 2 3")), "a@0 ");
    CHECK(readBody("g\no\nf 1 2 3").parts.empty());
    // Libraries named twice are one.
    CHECK_EQUAL(
        readBody("mtllib a.mtl b.mtl\nmtllib a.mtl\nmtllib my b.mtl\nf 1 2 3").libraries.size(),
        std::size_t{3});
}

// A million of everything that has a name takes seconds at most, not hours.
TEST(read_obj_many_names) {
    std::string text = kSquare;
    const int count = check::scaled(30000);
    for (int i = 0; i < count; ++i)
        text += cat("o o", i, "\ng g", i, "\nusemtl m", i, "\nmtllib l", i, ".mtl\ns ", i,
                    "\nf 1 2 3\n");
    const auto start = std::chrono::steady_clock::now();
    const Result file = readText(text);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const auto n = static_cast<std::size_t>(count);
    CHECK_EQUAL(file.parts.size(), n);
    CHECK_EQUAL(file.materials.size(), n);
    CHECK_EQUAL(file.libraries.size(), n);
    CHECK_EQUAL(file.mesh.triangleMaterials.back(), static_cast<std::uint32_t>(count - 1));
    CHECK_INFO(seconds.count() < 10 * check::stress(), seconds.count()); // 0.05 s measured
}

// What is read after damage is whole: indices in range, arrays of the same length.
TEST(read_obj_random_damage_and_cut_off) {
    const std::string whole = contentOf("tests/scenes/obj/room.obj");
    std::size_t read = 0, refused = 0;
    const auto checkText = [&](const std::string& text, const std::string& what) {
        MeshFile file;
        try {
            file = readText(text);
        } catch (const Error&) {
            ++refused;
            return;
        } catch (const std::exception& error) {
            CHECK_INFO(false, what << " threw " << error.what());
            return;
        }
        ++read;
        const MeshDesc& mesh = file.mesh;
        const auto inRange = [](std::span<const Corners> triangles, std::size_t count) {
            for (const Corners& t : triangles)
                for (const std::uint32_t i : t)
                    if (i >= count) return false;
            return true;
        };
        const std::size_t n = mesh.triangles.size();
        const auto isWhole = [&](const auto& array) { return array.empty() || array.size() == n; };
        CHECK_INFO(n > 0 && isWhole(mesh.uvTriangles) && isWhole(mesh.normalTriangles) &&
                       isWhole(mesh.triangleMaterials),
                   what);
        CHECK_INFO(inRange(mesh.triangles, mesh.points.size()), what);
        CHECK_INFO(inRange(mesh.uvTriangles, mesh.uvs.size()), what);
        CHECK_INFO(inRange(mesh.normalTriangles, mesh.normals.size()), what);
        for (const std::uint32_t slot : mesh.triangleMaterials)
            CHECK_INFO(slot < file.materials.size(), what);
        for (std::size_t i = 0; i < file.parts.size(); ++i)
            CHECK_INFO(i == 0 ? file.parts[0].firstTriangle == 0
                              : file.parts[i].firstTriangle > file.parts[i - 1].firstTriangle &&
                                    file.parts[i].firstTriangle < n,
                       what);
    };
    for (std::size_t size = 0; size < whole.size(); ++size)
        checkText(whole.substr(0, size), cat("cut off at ", size));
    const std::vector<std::string> pieces = {
        "f ",    "v ", "/",       "-",    "\\\n", "\n", "#",       "nan",  "0",
        "1e999", "9",  "usemtl ", "\r\n", "g ",   "\\", "\n1 2 3", "\xff", std::string(1, '\0')};
    for (std::uint32_t seed = 0; seed < check::scaled(4000u); ++seed)
        checkText(damage::damaged(whole, pieces, seed), cat("seed ", seed));
    CHECK_INFO(read > 300 && refused > 1000, "read " << read << ", refused " << refused);
}

} // namespace test_read_obj
