#include "read/json/object_list.h"

#include "read/in_turn.h"
#include "read/json/objects.h"

#include <cstdint>
#include <utility>

namespace {

// What a thread makes of a part: shapes that stand alone, and where the others are, which only
// whoever reads in order can read.
struct PartObjects {
    std::vector<ObjectDesc> lone;
    std::vector<std::uint8_t> types; // of these
    struct Other {
        std::size_t before = 0; // of the lone ones, so many stand in front
        SourceLoc loc;
    };
    std::vector<Other> others;
    bool isGood = false;
};

PartObjects readPart(const SourceFile& source, const JsonPart& part, const JsonSurroundings& with) {
    PartObjects objects;
    Diagnostics unheard;
    const ReadContext context{{}, unheard};
    JsonProblems problems(source, context);
    std::vector<MeshDesc> none;
    JsonGeometryReader reader(problems, with.rules, with.textures, with.materials, none);
    try {
        parseJsonItems(source, part, [&](const JsonValue& item) {
            auto lone = reader.readLone(item);
            if (auto object = lone ? loneObject(std::move(lone->geometry)) : std::nullopt) {
                objects.lone.push_back(std::move(*object));
                objects.types.push_back(static_cast<std::uint8_t>(lone->type));
            } else {
                objects.others.push_back({objects.lone.size(), item.loc()});
            }
        });
        objects.isGood = !problems.hasAny();
    } catch (const Error&) {
        // Reading in order tells.
    }
    return objects;
}

} // namespace

std::vector<ObjectDesc> readJsonObjects(const JsonSurroundings& with) {
    JsonProblems& problems = with.scene.problems();
    JsonGeometryReader reader(problems, with.rules, with.textures, with.materials, with.meshes);
    std::vector<std::size_t> roots;
    for (const JsonValue& object : with.scene.list("objects"))
        if (const auto root = reader.addRoot(object)) roots.push_back(*root);
    with.scene.reportUnknown();
    // A tree with errors could be larger than any memory.
    if (problems.hasErrors()) return {};
    JsonObjects list(problems, roots.size());
    for (const std::size_t root : roots) list.addRoot(reader.all(), root);
    return list.take();
}

std::optional<std::vector<ObjectDesc>> readJsonObjectsInParts(const SourceFile& source,
                                                              const JsonArrayScan& list,
                                                              int threads,
                                                              const JsonSurroundings& with) {
    Diagnostics unheard;
    const ReadContext context{{}, unheard};
    JsonProblems problems(source, context);
    JsonGeometryReader reader(problems, with.rules, with.textures, with.materials, with.meshes,
                              false);
    JsonObjects objects(problems, list.items);
    bool isGood = true;
    const auto use = [&](PartObjects part) {
        isGood = isGood && part.isGood;
        if (!isGood) return;
        std::size_t added = 0;
        const auto addUpTo = [&](std::size_t last) {
            const auto at = [&](std::size_t i) {
                return part.lone.begin() + static_cast<std::ptrdiff_t>(i);
            };
            for (std::size_t i = added; i < last; ++i) reader.addLone(part.lone[i], part.types[i]);
            objects.add(at(added), at(last));
            added = last;
        };
        for (const PartObjects::Other& other : part.others) {
            addUpTo(other.before);
            const JsonDocument item = parseJsonItem(source, other.loc);
            const auto root = reader.addRoot(item.root);
            if (root && !problems.hasErrors()) objects.addRoot(reader.all(), *root);
        }
        addUpTo(part.lone.size());
        isGood = !problems.hasAny();
    };
    inTurn<PartObjects>(
        threads, list.parts.size(),
        [&](std::size_t i) { return readPart(source, list.parts[i], with); }, use);
    if (!isGood) return {};
    with.scene.take("objects");
    with.scene.reportUnknown();
    return objects.take();
}
