// What several threads read is what one reads, in every bit and every message: large OBJ files in
// chunks, and the files that a scene names. (Pictures: test_ppm.cpp.)
#include "base/text.h"
#include "check.h"
#include "read/load.h"
#include "read/mesh/mesh_file.h"
#include "read/txt/read_txt.h"
#include "scene/scene.h"
#include "temporary_folder.h"

#include <algorithm>
#include <string>
#include <vector>

namespace test_read_threads {

namespace {

constexpr int kThreads[] = {2, 3, 8};

// All that was read or said, so that it can be compared.
struct Outcome {
    MeshFile file;
    std::string said;
    bool operator==(const Outcome& other) const {
        const auto partsEqual = [](const MeshFile::Part& a, const MeshFile::Part& b) {
            return a.name == b.name && a.firstTriangle == b.firstTriangle &&
                   a.loc.offset == b.loc.offset;
        };
        return file.mesh == other.file.mesh && file.materials == other.file.materials &&
               std::equal(file.parts.begin(), file.parts.end(), other.file.parts.begin(),
                          other.file.parts.end(), partsEqual) &&
               said == other.said;
    }
};
Outcome readWith(int threads, const std::string& text) {
    Outcome out;
    Diagnostics diagnostics;
    ReadOptions options;
    options.threads = threads;
    out.said = check::thrown([&] { out.file = readObj({"t.obj", text}, {options, diagnostics}); });
    for (const std::string& warning : diagnostics.warnings) out.said += warning + "\n";
    return out;
}
void checkSameForThreads(const std::string& text, const char* what) {
    const Outcome one = readWith(1, text);
    for (const int threads : kThreads)
        CHECK_INFO(readWith(threads, text) == one, what << ", " << threads << " threads");
}

// A wavy strip in lines of many kinds, about 3 MB: chunks have 1 MB.
std::string strip(bool withStates) {
    constexpr int kRows = 18'000;
    std::string text = "# strip\n";
    std::uint32_t state = 4;
    const auto random = [&](std::uint32_t below) {
        state = state * 1664525u + 1013904223u;
        return (state >> 8) % below;
    };
    for (int i = 0; i < kRows; ++i) {
        const std::string z = shortest(0.001 * random(1000)), x = std::to_string(i);
        text += "v " + x + " 0 " + z + (i % 5000 == 77 ? " 1 0 0\n" : "\n");
        text += random(9) == 0 ? "\tv " + x + " \\\n 1 " + z + "\r\n" : "v " + x + " 1 " + z + "\n";
        text += "vt " + x + " 0.5\nvn 0 " + z + " 1\n";
        if (i == 0) continue;
        const std::string a = std::to_string(2 * i - 1), b = std::to_string(2 * i),
                          n = std::to_string(i), m = std::to_string(i + 1);
        switch (random(6)) {
        case 0: text += "f -4 -2 -1 -3\n"; break;
        case 1: text += "f " + a + "/" + n + " -2/" + m + " -1/" + m + " # half\n"; break;
        case 2: text += "f " + a + "//" + n + " -2//" + m + " \\\n  " + b + "//" + n + "\n"; break;
        case 3: text += "fo " + a + "/1/1 -2/2/2 " + b + "/1/2\n"; break;
        case 4:
            text += random(50) == 0 ? "f " + a + " " + b + "\n" : "f " + a + " " + b + " -1\n";
            break;
        default: text += random(50) == 0 ? "f " + a + " -2 " + a + "\n" : "f -1 -2 -3\n"; break;
        }
        // Comments without blanks in front of long ones: what fills the chunks.
        text += "#" + std::string(random(150), '-') + "\n";
        if (withStates && i % 6000 == 4000)
            text += "g part" + n + "\ns " + n + "\nusemtl m" + n + "\n";
        if (withStates && i % 5000 == 600) text += "l 1 2\nnonsense\n";
    }
    return text;
}

} // namespace

TEST(read_threads_give_the_same_obj) {
    const std::string plain = strip(false), full = strip(true);
    CHECK_INFO(plain.size() > 5 << 19, plain.size());
    const Outcome one = readWith(1, full);
    CHECK_INFO(one.file.parts.size() >= 3 && one.file.mesh.triangles.size() > 16'000,
               one.file.parts.size() << " parts, " << one.said);
    checkSameForThreads(plain, "plain");
    checkSameForThreads("s 7\ng one\nusemtl first\nf 1 2 3\nusemtl second\n" + plain,
                        "with a smoothing group and the second material");
    checkSameForThreads(full, "with groups and materials");
    checkSameForThreads("\xef\xbb\xbf" + full, "with a byte order mark");
}

// A chunk ends neither in a line that goes on behind a backslash nor in front of a blank.
TEST(read_threads_keep_joined_lines_together) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    while (text.size() < 5 << 19) text += "f 1 \\\n2 \\\r\n3\n \t\n";
    const Outcome one = readWith(1, text);
    CHECK_INFO(one.said.empty() && one.file.mesh.triangles.size() == (text.size() - 24) / 16,
               one.said << one.file.mesh.triangles.size() << " of " << text.size());
    checkSameForThreads(text, "joined lines");
}

// A backslash at the end of a comment joins nothing, whoever looks: else there would be more
// vertices than were counted.
TEST(read_obj_comments_behind_numbers_end_their_line) {
    const std::string face = "f -1 -2 -3";
    for (const std::string comment : {"# c \\", " # c \\", "\t#\\", "#\\\r"})
        for (const int threads : {1, 3}) {
            const std::string end = comment + "\n", vertices = "v 0 0 0" + end + "v 1 0 0. " + end +
                                                               "v 0 1 1e0" + end + "vt 0 0" + end;
            const Outcome out = readWith(threads, vertices + face + end + vertices + face + end +
                                                      "f 1/ 2/ 3/" + end + "v 7 7 7\n" + face);
            CHECK_INFO(out.file.mesh.points.size() == 7 && out.file.mesh.triangles.size() == 4,
                       out.file.mesh.points.size() << " points, " << out.said);
        }
}

// Of several errors the first vertex's comes, and without one the first face's.
TEST(read_threads_find_the_same_error_in_obj) {
    const std::string text = strip(true);
    const auto lineAt = [&](std::size_t place) { return text.find("\nf ", place) + 1; };
    const auto with = [&](std::vector<std::pair<std::size_t, std::string>> lines) {
        std::string out = text;
        std::reverse(lines.begin(), lines.end());
        for (const auto& [place, line] : lines) out.insert(lineAt(place), line + "\n");
        return out;
    };
    const std::size_t first = text.size() / 3, second = text.size() / 2, third = text.size() - 500;
    const auto check = [&](const std::string& damaged, const std::string& words) {
        for (const int threads : kThreads) {
            const std::string said = readWith(threads, damaged).said;
            CHECK_INFO(said.find(words) != std::string::npos, threads << " threads: " << said);
        }
        checkSameForThreads(damaged, words.c_str());
    };
    check(with({{first, "f 1 2 x"}, {second, "v 1 2"}, {third, "v 1 2 y"}}), "'v', got the end");
    check(with({{first, "f 1 2 99999999"}, {second, "f 1 2 x"}}), "no vertex 99999999");
    check(with({{second, "f 1 2 y"}, {third, "f 1 2 0"}}), "got 'y'");
    check(with({{third, "vt x 1"}}), "expected a number after 'vt'");
    check(with({{first, "vn 0 0 inf"}, {third, "vt nan 1"}}), "2 vertices, normals or texture");
}

// Meshes of a scene: each file has a warning (colours) or an error, in the order of the scene.
TEST(read_threads_read_the_files_of_a_scene_in_its_order) {
    const TemporaryFolder folder("read-threads");
    std::string scene = "raytracer 1\ncamera c {\n}\nlight l {\n}\n", broken;
    for (int i = 0; i < 12; ++i) {
        const std::string name = cat("m", i);
        std::string text;
        for (int k = 0; k < 500 * (12 - i); ++k) // the first is the largest
            text += cat("v ", k, " 0 ", i, " 1 0 0\nv ", k, " 1 0 1 0 0\nv ", k,
                        " 1 1 1 0 0\nf -1 -2 -3\n");
        folder.write(name + ".obj", text);
        folder.write(name + "bad.obj", text + (i == 3 || i == 11 ? "f 1 2\n f 1 2 z\n" : ""));
        const std::string block = cat("mesh ", name, " {\n file ", name, ".obj\n}\ninstance ", name,
                                      " {\n mesh ", name, "\n}\n");
        scene += block;
        broken += cat("mesh b", name, " {\n file ", name, "bad.obj\n}\n");
    }
    const std::string good = folder.write("good.txt", scene),
                      bad = folder.write("bad.txt", scene + broken);
    const auto loadWith = [](int threads, const std::string& name, Diagnostics& diagnostics) {
        ReadOptions options;
        options.threads = threads;
        return load(name, diagnostics, options).desc;
    };
    Diagnostics one;
    const SceneDesc desc = loadWith(1, good, one);
    CHECK_EQUAL(one.warnings.size(), std::size_t{12});
    for (std::size_t i = 0; i < one.warnings.size(); ++i)
        CHECK_INFO(one.warnings[i].find(cat("m", i, ".obj:1:")) != std::string::npos,
                   one.warnings[i]);
    for (const int threads : kThreads) {
        Diagnostics diagnostics, ignored;
        CHECK_INFO(loadWith(threads, good, diagnostics) == desc, threads << " threads");
        CHECK_INFO(diagnostics.warnings == one.warnings, threads << " threads");
        const std::string said = check::thrown([&] { loadWith(threads, bad, ignored); });
        CHECK_INFO(said.find("m3bad.obj:18002:8: error:") != std::string::npos,
                   threads << " threads: " << said);
    }
}

// Pictures that are missing: the one that the materials use first is told.
TEST(read_threads_tell_the_first_missing_picture) {
    std::string text = "raytracer 1\ncamera c {\n look_at 0 -3 0  0 0 0  0 0 1\n}\n";
    for (int i = 0; i < 20; ++i) text += cat("texture t", i, " {\n file missing", i, ".png\n}\n");
    for (int i = 19; i >= 0; --i)
        text += cat("material m", i, " {\n diffuse_texture t", (i * 7 + 5) % 20, "\n}\n");
    const SourceFile source{"t.txt", text + "sphere s {\n material m1\n}\n"};
    const SceneDesc desc = readTxt(source);
    for (const int threads : {1, 2, 3, 8}) {
        RenderSettings settings;
        settings.picture = desc.settings;
        settings.threads = threads;
        const std::string said = check::thrown([&] { const Scene scene(desc, source, settings); });
        CHECK_INFO(said.find("texture 't18': no file") != std::string::npos,
                   threads << " threads: " << said);
    }
}

} // namespace test_read_threads
