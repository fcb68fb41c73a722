// Bad input never hurts (promise P6), for scenes in JSON: the corpus tests/bad/json, a scene cut
// off anywhere, and a scene with random damage give a scene or an Error, never a crash.
#include "base/text.h"
#include "check.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "read/read_json.h"
#include "read/read_txt.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

SceneDesc readValid(const SourceFile& source, bool lenient = false) {
    Diagnostics diagnostics;
    ReadOptions options;
    options.lenient = lenient;
    SceneDesc desc = readJson(source, {options, diagnostics});
    validate(desc, source, diagnostics);
    return desc;
}

// What is accepted must also survive being written and read again as native text.
enum class Outcome { Read, Refused };
Outcome readSomehow(const std::string& text, bool lenient) {
    SceneDesc desc;
    try {
        desc = readValid({"damaged.json", text}, lenient);
    } catch (const Error&) {
        return Outcome::Refused;
    }
    CHECK_INFO(readTxt({"again.txt", writeTxt(desc)}) == desc, "read from:\n" << text);
    return Outcome::Read;
}

const std::string kEverything = "tests/scenes/everything.json";

} // namespace

// NAME.expect has a line "line:col words" per error, or "- words" for those without a place.
TEST(bad_json_corpus) {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator("tests/bad/json")) {
        if (entry.path().extension() != ".json") continue;
        ++count;
        const std::string name = entry.path().string();
        fs::path expectPath = entry.path();
        std::ifstream expectations(expectPath.replace_extension(".expect"));
        const std::string message = check::thrown([&] {
            readValid({name, contentOf(entry.path())});
        });
        std::size_t expected = 0;
        for (std::string line; std::getline(expectations, line); ++expected) {
            const std::size_t blank = line.find(' ');
            const std::string place = line.substr(0, blank);
            const std::string words =
                cat(name, place == "-" ? "" : ":" + place, ": error: ", line.substr(blank + 1));
            CHECK_INFO(message.find(words) != std::string::npos, "expected '" << words << "' in\n"
                                                                              << message);
        }
        CHECK_INFO(expected > 0, expectPath << " is missing or empty");
    }
    CHECK_INFO(count >= 60, "files in tests/bad/json: " << count);
}

TEST(bad_json_cut_off_at_every_byte) {
    const std::string whole = contentOf(kEverything);
    CHECK(whole.size() > 2500);
    CHECK(readSomehow(whole, false) == Outcome::Read);
    const std::size_t last = whole.find_last_of('}');
    for (std::size_t size = 0; size <= last; ++size)
        CHECK_INFO(readSomehow(whole.substr(0, size), true) == Outcome::Refused, size);
}

TEST(bad_json_random_damage) {
    const std::string whole = contentOf(kEverything);
    const std::vector<std::string> pieces = {
        "{",      "}",        "[",          "]",         "\"",   ",",
        ":",      "\\",       "null",       "true",      "-",    "1e999",
        "1e-400", "0",        "4294967296", "\"keys\":", "[{}]", "\"ref\":\"stack\",",
        "\xff",   "\xc3",     "{}",         "\\ud800",   "1e60", std::string(1, '\0'),
        "[2,3]",  "\"node\"", "\"mesh\""};
    int read = 0, refused = 0;
    for (std::uint32_t seed = 0; seed < check::scaled(4000u); ++seed) {
        std::mt19937 random(seed);
        std::string text = whole;
        const auto place = [&] { return random() % (text.size() + 1); };
        for (auto damages = 1 + random() % 3; damages > 0; --damages) {
            const std::size_t at = place(), length = random() % 20;
            switch (random() % 6) {
            case 0: text.insert(at, pieces[random() % pieces.size()]); break;
            case 1: text.erase(at, length); break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(random());
                break;
            case 3: text.insert(place(), text.substr(at, length)); break;
            case 4: { // another number for one that is there
                const std::size_t digit = text.find_first_of("0123456789", at);
                if (digit != std::string::npos)
                    text[digit] = static_cast<char>('0' + random() % 10);
                break;
            }
            default:
                if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
                break;
            }
        }
        try {
            ++(readSomehow(text, seed % 2 == 0) == Outcome::Read ? read : refused);
        } catch (const std::exception& error) {
            CHECK_INFO(false, "seed " << seed << " threw " << error.what());
        }
    }
    // Both must happen, or the test tests nothing.
    CHECK_INFO(read > 300 && refused > 1000, "read " << read << ", refused " << refused);
}
