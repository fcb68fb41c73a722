// The seeds of the fuzzers are files that the readers accept, and what once crashed a reader no
// longer does. tests/fuzz/sound.h says what else has to hold of them.
#include "base/file_text.h"
#include "check.h"
#include "fuzz/png_parts.h"
#include "fuzz/sound.h"
#include "fuzz/targets.h"

#include <algorithm>
#include <filesystem>

namespace test_fuzz_seeds {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> filesIn(const fs::path& folder) {
    std::vector<std::string> names;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            names.push_back(entry.path().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

TEST(fuzz_seeds_are_read) {
    for (const fuzz::Target& target : fuzz::targets()) {
        const std::vector<std::string> names = filesIn(fs::path("tests/fuzz/seeds") / target.name);
        CHECK_INFO(names.size() >= 5 && names.size() <= 15, target.name << " " << names.size());
        for (const std::string& name : names) {
            const std::vector<std::uint8_t> bytes = readWholeFile(name);
            CHECK_INFO(bytes.size() < 4096, name << " has " << bytes.size() << " bytes");
            try {
                target.read(bytes);
            } catch (const std::exception& error) {
                CHECK_INFO(false, name << ": " << error.what());
            }
        }
    }
}

TEST(fuzz_regressions_stay_mended) {
    for (const fuzz::Target& target : fuzz::targets())
        for (const std::string& name : filesIn(fs::path("tests/fuzz/regressions") / target.name))
            try {
                run(target, readWholeFile(name));
            } catch (const std::exception& error) {
                CHECK_INFO(false, name << ": " << error.what());
            }
}

// The checks themselves: each refuses what it is there for.
TEST(fuzz_checks_see_what_is_unsound) {
    const auto error = [](const char* message) { return Error(ErrorKind::Input, message); };
    fuzz::checkError(error("input:1:2: error: right"), "input");
    CHECK_THROWS(fuzz::checkError(Error(ErrorKind::Usage, "input: error: x"), "input"),
                 "not an error of input");
    CHECK_THROWS(fuzz::checkError(error("other: error: x"), "input"), "without the file's name");
    CHECK_THROWS(fuzz::checkError(error("input: x"), "input"), "without 'error'");
    CHECK_THROWS(fuzz::checkError(error("input: error: \033[2J"), "input"), "the byte 27");
    CHECK_THROWS(fuzz::checkWarnings({{"input: error: x"}, {}}, "input"), "without 'warning'");

    StoredImage picture{2, 1, 1, StoredImage::Depth::Float, {}, {}, {0, 1}};
    fuzz::checkPicture(picture);
    picture.floats[1] = std::numeric_limits<float>::infinity();
    CHECK_THROWS(fuzz::checkPicture(picture), "not finite");
    picture.floats.pop_back();
    CHECK_THROWS(fuzz::checkPicture(picture), "1 floats for 2 samples");

    // What writeTxt() leaves out is not to be there: a cube has no radius of its own.
    SceneDesc desc;
    desc.cameras.emplace_back().name = "c";
    desc.objects.emplace_back().name = "o";
    fuzz::checkScene(desc, {"input", ""});
    desc.objects[0].kind = ObjectDesc::Kind::Cube;
    desc.objects[0].radius = 2;
    CHECK_THROWS(fuzz::checkScene(desc, {"input", ""}), "reads back differently");
}

TEST(fuzz_png_parts) {
    const std::vector<std::uint8_t> png = readWholeFile("tests/scenes/png/size_5x4_i.png");
    CHECK(fuzz::withRightChecksums(png) == png);
    std::vector<std::uint8_t> damaged = png;
    damaged[29] ^= 255; // in the checksum of the first chunk
    CHECK(fuzz::withRightChecksums(damaged) == png);
    for (std::size_t size = 0; size < png.size(); ++size) { // cut off: as much as there is
        const std::span<const std::uint8_t> part = std::span(png).first(size);
        CHECK_EQUAL(fuzz::withRightChecksums(part).size(), size);
    }
}

} // namespace test_fuzz_seeds
