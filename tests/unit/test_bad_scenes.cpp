// Bad input never hurts (promise P6): the corpus tests/bad/txt, files cut off anywhere, and files
// with random damage give a scene or an Error, never a crash.
#include "base/text.h"
#include "check.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "read/load.h"
#include "read/mesh/read_mtl.h"
#include "read/txt/read_txt.h"
#include "unit/damage.h"

#include <filesystem>
#include <fstream>

namespace test_bad_scenes {

namespace {

using damage::contentOf;
using damage::isRead;
namespace fs = std::filesystem;

// What is accepted must also survive being written and read again.
void readSound(const std::string& text) {
    const SourceFile source{"damaged.txt", text};
    Diagnostics diagnostics;
    const SceneDesc desc = readTxt(source);
    validate(desc, source, diagnostics);
    CHECK_INFO(readTxt({"again.txt", writeTxt(desc)}) == desc, "read from:\n" << text);
}

// Every file of tests/bad/FORMAT is refused with the message that its NAME.expect asks for: a line
// "line:col words" per error, or "- words" for those without a place.
template <class Read>
void checkCorpus(const std::string& format, std::size_t fewest, const Read& read) {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator("tests/bad/" + format)) {
        if (entry.path().extension() != "." + format) continue;
        ++count;
        fs::path expectPath = entry.path();
        std::ifstream expectations(expectPath.replace_extension(".expect"));
        CHECK_INFO(expectations.good(), expectPath << " is missing");
        const std::string name = entry.path().string();
        std::string message;
        ErrorKind kind = ErrorKind::Usage;
        try {
            read(name);
        } catch (const Error& error) {
            message = error.what();
            kind = error.kind();
        }
        CHECK_INFO(kind == ErrorKind::Input, name << " was read without an error");
        std::size_t expected = 0;
        for (std::string line; std::getline(expectations, line); ++expected) {
            const std::size_t blank = line.find(' ');
            const std::string place = line.substr(0, blank);
            const std::string words =
                cat(name, place == "-" ? "" : ":" + place, ": error: ", line.substr(blank + 1));
            CHECK_INFO(message.find(words) != std::string::npos, "expected '" << words << "' in\n"
                                                                              << message);
        }
        CHECK_INFO(expected > 0, expectPath << " is empty");
    }
    CHECK_INFO(count >= fewest, "files in tests/bad/" << format << ": " << count);
}

void loadIt(const std::string& name) {
    Diagnostics diagnostics;
    load(name, diagnostics);
}

} // namespace

TEST(bad_txt_corpus) { checkCorpus("txt", 40, loadIt); }
TEST(bad_json_corpus) { checkCorpus("json", 30, loadIt); }
TEST(bad_nff_corpus) { checkCorpus("nff", 20, loadIt); }
TEST(bad_obj_corpus) { checkCorpus("obj", 20, loadIt); }
TEST(bad_ply_corpus) { checkCorpus("ply", 20, loadIt); }
TEST(bad_mtl_corpus) {
    checkCorpus("mtl", 10, [](const std::string& name) {
        Diagnostics diagnostics;
        readMtl({name, contentOf(name)}, {{}, diagnostics});
    });
}

TEST(bad_txt_cut_off_at_every_byte) {
    const std::string whole = contentOf("tests/scenes/everything.txt");
    CHECK(whole.size() > 2000);
    readSound(whole);
    std::size_t refused = 0;
    for (std::size_t size = 0; size < whole.size(); ++size)
        if (!isRead([&] { readSound(whole.substr(0, size)); })) ++refused;
    // Only a cut between two blocks near the end, where no name is missing, leaves a whole scene.
    CHECK(refused > whole.size() * 9 / 10);
}

TEST(bad_txt_random_damage) {
    const std::string whole = contentOf("tests/scenes/everything.txt");
    const std::vector<std::string> pieces = {
        "{",    "}",    "\"",       "\\",         "\n",
        "\r",   "#",    "-",        "nan",        "1e999",
        "0",    " ",    "key\n",    "4294967296", std::string(1, '\0'),
        "\xff", "\xc3", "material", "1e-400"};
    const auto [read, refused] = damage::inflict(
        whole, pieces, 4000, [](const std::string& text, std::uint32_t) { readSound(text); });
    // Both must happen, or the test tests nothing.
    CHECK_INFO(read > 100 && refused > 1000, "read " << read << ", refused " << refused);
}

} // namespace test_bad_scenes
