// Bad input never hurts (promise P6): the corpus tests/bad/txt, files cut off anywhere, and files
// with random damage give a scene or an Error, never a crash.
#include "base/text.h"
#include "check.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "read/load.h"
#include "read/read_mtl.h"
#include "read/read_txt.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// What is accepted must also survive being written and read again.
enum class Outcome { Read, Refused };
Outcome readSomehow(const std::string& text) {
    const SourceFile source{"damaged.txt", text};
    SceneDesc desc;
    try {
        Diagnostics diagnostics;
        desc = readTxt(source);
        validate(desc, source, diagnostics);
    } catch (const Error&) {
        return Outcome::Refused;
    }
    CHECK_INFO(readTxt({"again.txt", writeTxt(desc)}) == desc, "read from:\n" << text);
    return Outcome::Read;
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
    CHECK(readSomehow(whole) == Outcome::Read);
    std::size_t refused = 0;
    for (std::size_t size = 0; size < whole.size(); ++size)
        if (readSomehow(whole.substr(0, size)) == Outcome::Refused) ++refused;
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
    int read = 0, refused = 0;
    for (std::uint32_t seed = 0; seed < check::scaled(4000u); ++seed) {
        std::mt19937 random(seed);
        std::string text = whole;
        const auto place = [&] { return random() % (text.size() + 1); };
        for (auto damages = 1 + random() % 3; damages > 0; --damages) {
            const std::size_t at = place(), length = random() % 20;
            switch (random() % 5) {
            case 0: text.insert(at, pieces[random() % pieces.size()]); break;
            case 1: text.erase(at, length); break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(random());
                break;
            case 3: text.insert(place(), text.substr(at, length)); break;
            default:
                if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
                break;
            }
        }
        try {
            ++(readSomehow(text) == Outcome::Read ? read : refused);
        } catch (const std::exception& error) {
            CHECK_INFO(false, "seed " << seed << " threw " << error.what());
        }
    }
    // Both must happen, or the test tests nothing.
    CHECK_INFO(read > 100 && refused > 1000, "read " << read << ", refused " << refused);
}
