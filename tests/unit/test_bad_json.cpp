// Bad input never hurts (promise P6), for scenes in JSON: the corpus tests/bad/json, a scene cut
// off anywhere, and a scene with random damage give a scene or an Error, never a crash.
#include "base/text.h"
#include "check.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "read/json/read_json.h"
#include "read/txt/read_txt.h"
#include "unit/damage.h"

#include <string>
#include <vector>

namespace test_bad_json {

namespace {

using damage::contentOf;

SceneDesc readValid(const SourceFile& source, bool lenient = false) {
    Diagnostics diagnostics;
    ReadOptions options;
    options.lenient = lenient;
    SceneDesc desc = readJson(source, {options, diagnostics});
    validate(desc, source, diagnostics);
    return desc;
}

// What is accepted must also survive being written and read again as native text.
void readSound(const std::string& text, bool lenient) {
    const SceneDesc desc = readValid({"damaged.json", text}, lenient);
    CHECK_INFO(readTxt({"again.txt", writeTxt(desc)}) == desc, "read from:\n" << text);
}

const std::string kEverything = "tests/scenes/everything.json";

} // namespace

// Names that are listed may have any bytes; messages have none that a terminal would take for more
// than a character.
TEST(bad_json_names_in_messages) {
    Diagnostics diagnostics;
    readJson({"names.json", contentOf("tests/fuzz/seeds/json/nul_names.json")}, {{}, diagnostics});
    bool isListed = false;
    for (const std::string& line : diagnostics.warnings) {
        CHECK_INFO(line.find('\0') == std::string::npos, line);
        isListed |= line.find("known: it's\\x00 b") != std::string::npos;
    }
    CHECK(isListed);
}

TEST(bad_json_cut_off_at_every_byte) {
    const std::string whole = contentOf(kEverything);
    CHECK(whole.size() > 2500);
    readSound(whole, false);
    const std::size_t last = whole.find_last_of('}');
    for (std::size_t size = 0; size <= last; ++size)
        CHECK_INFO(!damage::isRead([&] { readSound(whole.substr(0, size), true); }), size);
}

TEST(bad_json_random_damage) {
    const std::string whole = contentOf(kEverything);
    const std::vector<std::string> pieces = {
        "{",      "}",        "[",          "]",         "\"",   ",",
        ":",      "\\",       "null",       "true",      "-",    "1e999",
        "1e-400", "0",        "4294967296", "\"keys\":", "[{}]", "\"ref\":\"stack\",",
        "\xff",   "\xc3",     "{}",         "\\ud800",   "1e60", std::string(1, '\0'),
        "[2,3]",  "\"node\"", "\"mesh\""};
    const auto [read, refused] =
        damage::inflict(whole, pieces, 4000, [](const std::string& text, std::uint32_t seed) {
            readSound(text, seed % 2 == 0);
        });
    // Both must happen, or the test tests nothing.
    CHECK_INFO(read > 300 && refused > 1000, "read " << read << ", refused " << refused);
}

} // namespace test_bad_json
