// Lines that say what the block before said: blocks with them are what they would be without.
#include "read/txt/read_txt.h"

#include "base/text.h"
#include "check.h"
#include "verify/meshes.h"

#include <array>

namespace test_txt_repeats {

using meshes::Random;

namespace {

// Properties in some order with values that are often the same ones, some the start of others, and
// a comment of its own behind every line if `marked`: no line is then like another.
std::string someScene(Random random, std::size_t blocks, bool marked) {
    constexpr std::array kValues = {"0.2", "0.25", "0.5", "0.2 ", "1e-1", "0", "00.2"};
    std::size_t lines = 0;
    const auto line = [&](std::string_view keyword, std::size_t numbers) {
        std::string out(keyword);
        const bool isPlain = random.chance(0.7);
        for (std::size_t i = 0; i < numbers; ++i)
            out += cat(" ", kValues[isPlain ? i : random.below(kValues.size())]);
        return out + (marked ? cat(" # ", ++lines, "\n") : "\n");
    };
    std::string text = "raytracer 1\n";
    for (std::size_t i = 0; i < blocks; ++i) {
        text += cat("material m", i, " {\n");
        if (random.chance(0.9)) text += line("diffuse", 3);
        if (random.chance(0.5)) text += line("roughness", 1);
        text += line("mirror", 3);
        text += cat("}\ncone c", i, " {\n");
        if (random.chance(0.7)) text += line("radius", 1);
        text += line("top_radius", 1);
        text += "caps false\n";
        text += cat("material m", random.below(i + 1), "\n}\nlight l", i, " {\n");
        text += random.chance(0.5) ? line("attenuation", 3) : line("color", 3);
        text += "}\n";
    }
    return text;
}

std::string messageOf(const std::string& text) {
    try {
        readTxt({"t.txt", text});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(txt_repeated_lines_mean_the_same_again) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const SceneDesc some = readTxt({"t.txt", someScene(Random(seed), 100, false)});
        const SceneDesc marked = readTxt({"t.txt", someScene(Random(seed), 100, true)});
        CHECK_INFO(some == marked, "seed " << seed);
    }
}

// A mistake is told of every line that has it, and a line that is given twice is one.
TEST(txt_repeated_mistakes_are_told_again) {
    std::string text = "raytracer 1\n";
    for (int i = 0; i < 3; ++i) text += cat("sphere s", i, " {\nradius -1\n}\n");
    const std::string message = messageOf(text);
    for (const int at : {3, 6, 9})
        CHECK_INFO(message.find(cat("t.txt:", at, ":8: error: 'radius' must be")) !=
                       std::string::npos,
                   message);
    const std::string twice =
        "raytracer 1\nsphere a {\nradius 2\n}\nsphere b {\nradius 2\nradius 2\n}";
    CHECK_INFO(messageOf(twice).find("t.txt:7:1: error: 'radius' was given already at line 6") !=
                   std::string::npos,
               messageOf(twice));
    // Nor is a line the same that the file ends in.
    const std::string cut = "raytracer 1\nsphere a {\nradius 2\n}\nsphere b {\nradius 2";
    CHECK_INFO(messageOf(cut).find("block 'sphere' is not closed") != std::string::npos,
               messageOf(cut));
}

} // namespace test_txt_repeats
