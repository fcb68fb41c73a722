// Native text that threads read in parts is what one thread reads: every block, its place in the
// file and every message, wherever parts end.
#include "base/text.h"
#include "check.h"
#include "desc/properties.h"
#include "read/txt/read_blocks.h"
#include "read/txt/read_txt.h"

#include <string>
#include <utility>
#include <vector>

namespace test_txt_parts {

namespace {

struct Outcome {
    SceneDesc desc;
    std::vector<std::uint32_t> places; // of the blocks; two places always compare equal in a desc
    std::string said;
    bool operator==(const Outcome&) const = default;
};
Outcome readWith(const std::string& text, int threads, std::size_t partBytes) {
    Outcome out;
    const SourceFile source{"t.txt", text};
    out.said = check::thrown([&] { out.desc = readTxt(source, threads, partBytes); });
    forEachBlock(out.desc, [&](const auto& block) { out.places.push_back(block.loc.offset); });
    return out;
}
Outcome inOrder(const std::string& text) { return readWith(text, 1, 0); }

// Names before and behind what they name, line ends of both kinds, braces where none ends a block.
constexpr std::string_view kText =
    "\xef\xbb\xbfraytracer 1 # first }\n"
    "world {\r\n    environment sky\r\n    background 1 1 1\r\n}\r\n"
    "# }\n"
    "material \"a } b\" {\n    diffuse_texture \"wood\"\n\t} # end }\n"
    "texture wood {\n    file \"x}\\\"}.png\"\n}\n\n\n"
    "mesh \"m\\\\1\" {\n    points 3 # }\n 0 0 0\n 1 0 0 0\n 1 0 }\n"
    "sphere one {\n    material \"a } b\"\n    #}\n    radius 2\n}\n"
    "sphere two {\n    material late\n    translate 1 2 3\n  }\t\n"
    "instance three {\n    mesh \"m\\\\1\"\n    key\n    materials "
    "late \"a } b\" late\n}\n"
    "light lamp {\n    translate 0 0 5\n}\n"
    "material late {\n    specular 1 1 1\n}\n"
    "texture sky {\n    file sky.pfm\n}\n"
    "camera eye {\n}\n"
    "settings {\n    seed 7\n}";

std::string goodText() {
    std::string text(kText);
    const std::string bad = "\n 1 0 0 0\n 1 0 }\n";
    return text.replace(text.find(bad), bad.size(),
                        "\n 1 0 0 0\n 1 0\n    triangles 1\n 0 1 2\n}\n");
}

// A mesh whose arrays are worth several threads, with `line` in the middle of its points.
std::string largeMesh(const std::string& lineEnd, const std::string& line = "") {
    constexpr int kPoints = 12'000;
    std::string text = "raytracer 1\nmesh m {\n    points " + std::to_string(kPoints) + lineEnd;
    for (int i = 0; i < kPoints; ++i)
        text += (i == kPoints / 2 ? line : "") + std::to_string(i) + " 0.5 -" +
                std::to_string(i % 17) + "e-3" + lineEnd;
    text += "    triangles " + std::to_string(kPoints) + lineEnd;
    for (int i = 0; i < kPoints; ++i) text += "  0\t" + std::to_string(i) + "  1 " + lineEnd;
    return text + "}\ninstance i {\n    mesh m\n}\n";
}

constexpr std::pair<int, std::size_t> kWays[] = {{2, 1}, {3, 40}, {2, 90}, {4, 200}};
void checkSame(const std::string& text, const std::string& what) {
    const Outcome one = inOrder(text);
    for (const auto& [threads, partBytes] : kWays)
        CHECK_INFO(readWith(text, threads, partBytes) == one,
                   what << ": " << threads << " threads, parts of " << partBytes << "; "
                        << readWith(text, threads, partBytes).said << " instead of " << one.said);
}

} // namespace

TEST(txt_parts_begin_behind_blocks) {
    const std::string text = goodText();
    const std::size_t first = text.find('\n') + 1;
    for (std::size_t bytes = 1; bytes < text.size(); ++bytes) {
        const std::vector<TxtPart> parts = partsOf(text, first, bytes, 2);
        std::size_t at = first;
        for (const TxtPart& part : parts) {
            CHECK_INFO(part.first == at && part.last > at, bytes);
            at = part.last;
            const std::string before = text.substr(0, at);
            CHECK_INFO(at == text.size() || before.ends_with("}\n") || before.ends_with("}\r\n") ||
                           before.ends_with("} # end }\n") || before.ends_with("  }\t\n"),
                       bytes << ": " << before.substr(before.size() - 12));
        }
        CHECK_INFO(at == text.size(), bytes);
    }
    CHECK_INFO(partsOf(text, first, 1, 2).size() == 12, partsOf(text, first, 1, 2).size());
}

TEST(txt_parts_give_the_same_scene) {
    const Outcome one = inOrder(goodText());
    CHECK_INFO(one.said.empty() && one.desc.objects.size() == 3, one.said);
    checkSame(goodText(), "good");
    std::string windows;
    for (const char c : goodText()) windows += c == '\n' ? "\r\n" : std::string(1, c);
    checkSame(windows, "line ends of Windows");
}

// Any line may be wrong, on either side of a border: the first mistake of the file is told, with
// all that was wrong before it.
TEST(txt_parts_find_the_same_mistakes) {
    const std::string text = goodText();
    const Outcome good = inOrder(text);
    int wrong = 0;
    for (std::size_t line = 0; line < text.size(); line = text.find('\n', line) + 1) {
        for (const std::string damage :
             {"}\n", "radius -1\n", "sphere x {\n", "material nobody\n", "\"open\n",
              "settings {\n}\n", "mesh late {\n points 2 0 0 0\n }\n", "material late {\n}\n",
              "#\n", "{", "\x01"}) {
            std::string damaged = text;
            damaged.insert(line, damage);
            checkSame(damaged, cat("byte ", line, " ", damage));
            wrong += inOrder(damaged).said.empty() ? 0 : 1;
        }
        const std::string shortened = text.substr(0, line);
        checkSame(shortened, cat("the first ", line, " bytes"));
        if (text.find('\n', line) == std::string::npos) break;
    }
    CHECK_INFO(wrong > 250, wrong); // of 42 lines times 11
    checkSame(std::string(kText), "an array that ends too early");
    checkSame("", "nothing");
    checkSame("raytracer 2\n" + text, "another version");
}

// A part of many errors shows the first ones of the file and counts all.
TEST(txt_parts_count_the_same_errors) {
    std::string text = "raytracer 1\n";
    for (int i = 0; i < 60; ++i) text += "sphere s" + std::to_string(i) + " {\n    radius -1\n}\n";
    checkSame(text, "60 errors");
    CHECK(inOrder(text).said.ends_with("and 40 more errors"));
}

TEST(txt_arrays_are_the_same_for_any_threads) {
    for (const std::string lineEnd : {"\n", " \r\n"}) {
        checkSame(largeMesh(lineEnd), "large");
        CHECK(inOrder(largeMesh(lineEnd)).desc.meshes.at(0).points.size() == 12'000);
    }
    // What is not a group on each line is read number by number, or is a mistake.
    for (const std::string line :
         {"# comment\n", "\n", "0 0\n", "1e99 0 0\n", "0 0 x\n", "}\n", "7 "})
        checkSame(largeMesh("\n", line), line);
    std::string text = largeMesh("\n");
    checkSame(text.substr(0, text.size() - 100), "cut off");
    checkSame(text.replace(text.find("\t11999  1"), 9, "\t12000  1"), "an index too large");
    CHECK(inOrder(text).said.find("there is no 12000 in 'points'") != std::string::npos);
}

} // namespace test_txt_parts
