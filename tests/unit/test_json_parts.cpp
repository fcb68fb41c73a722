// JSON whose objects are read in parts, on any number of threads, is what a tree of all values
// gives: every object, its place in the file and every message.
#include "base/text.h"
#include "check.h"
#include "read/json/json.h"
#include "read/json/read_json.h"
#include "unit/read_outcome.h"

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace test_json_parts {

namespace {

constexpr std::size_t kNever = static_cast<std::size_t>(-1);

using Outcome = check::ReadOutcome;

Outcome checkSame(const std::string& text, const std::string& what, bool lenient = false) {
    const SourceFile source{"t.json", text};
    const auto readWith = [&](int threads, std::size_t partBytes) {
        return check::outcomeOf([&](Diagnostics& diagnostics) {
            ReadOptions options;
            options.threads = threads;
            options.lenient = lenient;
            return readJson(source, {options, diagnostics}, partBytes);
        });
    };
    Outcome one = readWith(1, kNever);
    check::checkParts(one, {{1, 1}, {3, 1}, {2, 150}}, what, readWith);
    return one;
}

// Shapes with and without names, the same name twice, and those that can't be read alone between
// them; keys before and behind the list.
std::string sceneOf(const std::vector<std::string>& objects, const std::string& behind = "") {
    std::string text = R"({ "AA": {"samples": 1},
 "materials": [{"name": "a", "ID": 0, "hardness": 1}, {"name": "b", "ID": 1}],
 "objects" : [)";
    for (std::size_t i = 0; i < objects.size(); ++i)
        text += (i > 0 ? i % 3 == 0 ? " ,\n\t" : "," : " \n") + objects[i];
    return text + " ]\n, \"lights\": [{\"type\": \"point\", \"position\": [0, 1, 2]}]" + behind +
           "}";
}
const std::vector<std::string> kObjects = {
    R"({"type": "sphere", "radius": 2, "materials": [0]})",
    R"({"name": "x", "type": "sphere", "position": [1, 2, 3.5], "materials": ["b"]})",
    R"({"type": "box", "min": [0, 0, 0], "max": [1, 2, 3], "materials": [1]})",
    R"({"name": "x", "type": "cube", "scale": 0.25, "comment": "[{\"]}"})",
    R"({"type": "node", "position": [1, 0, 0], "children": [
        {"type": "sphere"}, {"name": "in", "type": "cone"}, {"type": "node", "children": []}]})",
    R"({"type": "sphere", "materials": [1]})",
    R"({"type": "mesh", "filepath": "a/b.obj"})",
    R"({"type": "plane", "normal": [0, 1, 0], "position": [0, -1, 0], "materials": [0, 1]})",
    R"({"name": "y\\\u00e4\"", "type": "disk", "keys": [{"position": [0, 0, 1]}, {}]})",
    R"({"type": "mesh", "filepath": "a/b.obj"})",
    R"({"type": "sphere", "radius": 0.001})",
};

} // namespace

TEST(json_parts_give_the_same_scene) {
    const Outcome all = checkSame(sceneOf(kObjects), "all kinds");
    CHECK_INFO(all.said.empty() && all.desc.objects.size() == 12 && all.desc.meshes.size() == 1,
               all.said << all.desc.objects.size() << " objects");
    CHECK_EQUAL(all.desc.objects.back().name, "sphere4");
    CHECK_EQUAL(all.desc.objects.at(3).name, "x.2");
    CHECK(all.desc.objects.at(8).materials == std::vector<Handle>({0, 1}));
    // Of two that could be meant the first one is, though it is read elsewhere.
    std::vector<std::string> named = kObjects;
    named.insert(named.begin(), R"({"name": "in", "type": "sphere", "radius": 3})");
    named.emplace_back(R"({"type": "instance", "ref": "in"})");
    const Outcome referring = checkSame(sceneOf(named), "a reference");
    CHECK_EQUAL(referring.desc.objects.back().radius, 3.0);
    for (const char* list : {"", "1", "\"a\", [], {}", "null, {\"type\": \"sphere\"}"})
        checkSame(sceneOf({list}), list);
    checkSame("{\"objects\": {\"objects\": [{}]}}", "no list");
    checkSame("{\"materials\": [{\"objects\": [{}]}], \"objects\": [{\"type\": \"cube\"}]}",
              "the objects decide");
}

// What has to be said of one object, wherever it stands, and of what stands around them.
TEST(json_parts_give_the_same_messages) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {R"({"type": "sphere", "radius": -1})", "'radius'"},
        {R"({"type": "sphere", "colour": 1})", "unknown key 'colour'"},
        {R"({"type": "ball"})", "unknown type"},
        {R"({"type": "sphere", "materials": ["c"]})", "unknown material"},
        {R"({"type": "plane", "normal": [1, 0, 0], "materials": [0, 1]})", "is vertical"},
        {R"({"type": "instance", "ref": "x"})", ""},
        {R"({"type": "node", "ref": "late"})", "no earlier"},
        {R"({"type": "sphere", "type": "cube"})", "given already"},
        {R"({"type": "sphere" "radius": 1})", "expected ','"},
        {R"({"type": "sphere", "radius": 01})", "no octal"},
        {R"({"type": "sphere", "name": "a)", "error"},
        {"{\"type\": \"sphere\", \"name\": \"\xff\"}", "not UTF-8"},
        {R"(}, {"type": "sphere")", "expected a value"},
        {R"([{"type": "sphere"}])", "expected an object"},
        {R"({"type": "sphere"},)", "error"},
        {R"({"type": "sphere"}])", "error"},
        {"7", "expected an object"},
    };
    for (const auto& [object, words] : cases)
        for (const std::size_t at : {std::size_t{0}, std::size_t{5}, kObjects.size()}) {
            std::vector<std::string> objects = kObjects;
            objects.insert(objects.begin() + static_cast<std::ptrdiff_t>(at), object);
            for (const bool lenient : {false, true}) {
                const Outcome one = checkSame(sceneOf(objects), object, lenient);
                const std::string said = one.said + join(one.warnings, "\n");
                const bool hasNoTarget = words.empty() && at == 0;
                CHECK_INFO(said.find(hasNoTarget ? "no earlier" : words) != std::string::npos,
                           object << " at " << at << ": " << said);
            }
        }
    for (const char* behind : {", \"objects\": []", ", \"fog\": 1", ", \"camera\": 3", "]", ", "})
        for (const bool lenient : {false, true}) {
            const Outcome one = checkSame(sceneOf(kObjects, behind), behind, lenient);
            CHECK_INFO(!one.said.empty() || !one.warnings.empty(), behind);
        }
    const std::string whole = sceneOf(kObjects);
    for (std::size_t size = 0; size < whole.size(); size += 7)
        CHECK(!checkSame(whole.substr(0, size), "cut off").said.empty());
}

TEST(json_parts_give_the_same_for_all_examples) {
    const int count = check::forEachFile(
        {"tests/scenes/json", "tests/bad/json", "ASCII"}, ".json",
        [](const std::string& text, const std::string& name) { checkSame(text, name); });
    CHECK_INFO(count > 40, count << " files");
}

TEST(json_parts_give_the_same_after_random_damage) {
    const std::vector<std::string> pieces = {"{", "}", "[",  "]",    "\"",      ",",
                                             ":", "-", "\\", "\\\"", "\"ref\"", "\"type\":"};
    int said = 0;
    const int cases = check::scaled(600);
    for (int seed = 0; seed < cases; ++seed) {
        const std::string text =
            damage::damaged(sceneOf(kObjects), pieces, static_cast<std::uint32_t>(seed));
        said += !checkSame(text, cat("seed ", seed)).said.empty();
    }
    CHECK_INFO(said > cases / 3 && said < cases, said << " of " << cases);
}

// Texts full of brackets, quotes and backslashes: items are where a loop over the bytes finds them,
// at whatever byte of a block they begin.
TEST(json_parts_are_where_items_end) {
    constexpr std::uint32_t kSeed = 5;
    std::mt19937 random(kSeed);
    constexpr std::string_view kBytes = "ab[]{},: ";
    for (int i = 0, cases = check::scaled(3000); i < cases; ++i) {
        std::string text = "[";
        std::vector<std::size_t> ends; // of items
        for (auto items = 1 + random() % 4; items > 0; --items) {
            std::string item = "[";
            for (auto length = random() % 70; length > 0; --length) {
                item += '"';
                for (auto inside = random() % 9; inside > 0; --inside) switch (random() % 4) {
                    case 0: item += "\\\\"; break;
                    case 1: item += "\\\""; break;
                    default: item += kBytes[random() % kBytes.size()];
                    }
                item += length > 1 ? "\" ," : "\"";
            }
            text += item + "]";
            ends.push_back(text.size());
            if (items > 1) text += ",";
        }
        text += std::string(random() % 3, ' ') + "]";
        const std::string whole = text + " [\"";
        const JsonArrayScan scan = scanJsonArray(whole.data(), whole.data() + whole.size(), 1);
        bool isSame = scan.items == ends.size() && scan.parts.size() == ends.size() &&
                      scan.end == whole.data() + text.size();
        for (std::size_t k = 0; isSame && k < ends.size(); ++k)
            isSame = scan.parts[k].last == whole.data() + ends[k] &&
                     scan.parts[k].first == (k == 0 ? whole.data() : scan.parts[k - 1].last) &&
                     scan.parts[k].before == (k == 0 ? '[' : ',');
        CHECK_INFO(isSame, "case " << i << " of seed " << kSeed << ": " << text);
        const JsonArrayScan open = scanJsonArray(text.data(), text.data() + text.size() - 1, 1);
        CHECK_INFO(!open.end, text);
    }
}

// Long lists do come in parts, and what is left of the document has none of their items.
TEST(json_parts_leave_out_the_list) {
    const SourceFile source{"t.json", sceneOf(kObjects)};
    const JsonOutline outline = parseJsonOutline(source, "objects", 100);
    CHECK_EQUAL(outline.list.items, kObjects.size());
    CHECK_INFO(outline.list.parts.size() > 5, outline.list.parts.size());
    const JsonValue* objects = outline.document.root.find("objects");
    CHECK(objects && objects->isArray() && objects->items().empty());
    CHECK(outline.document.root.find("lights")->items().size() == 1);
    std::size_t items = 0;
    for (const JsonPart& part : outline.list.parts)
        parseJsonItems(source, part, [&](const JsonValue& item) {
            CHECK_EQUAL(item.members().size(),
                        parseJsonItem(source, item.loc()).root.members().size());
            ++items;
        });
    CHECK_EQUAL(items, kObjects.size());
}

} // namespace test_json_parts
