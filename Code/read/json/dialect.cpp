#include "read/json/json.h"

#include <algorithm>
#include <array>

namespace {

using Test = bool (*)(const JsonValue& scene);

// Is there one among the objects of the scene, however deep?
template <class Predicate> bool anyGeometry(const JsonValue* list, const Predicate& is) {
    const auto items = list ? list->items() : std::span<const JsonValue>();
    return std::any_of(items.begin(), items.end(), [&](const JsonValue& item) {
        return is(item) || anyGeometry(item.find("children"), is);
    });
}
template <class Predicate> bool anyObject(const JsonValue& scene, const Predicate& is) {
    return anyGeometry(scene.find("objects"), is);
}
bool materialsHave(const JsonValue& scene, std::string_view key) {
    const JsonValue* list = scene.find("materials");
    const auto items = list ? list->items() : std::span<const JsonValue>();
    return std::any_of(items.begin(), items.end(),
                       [&](const JsonValue& material) { return material.find(key) != nullptr; });
}
bool isOfType(const JsonValue& object, std::string_view type) {
    const JsonValue* value = object.find("type");
    return value && value->text() == type;
}
bool hasNumberedMaterials(const JsonValue& object) {
    const JsonValue* list = object.find("materials");
    return list && !list->items().empty() && list->items().front().isNumber();
}

// C++ of 2022 and Python of winter 2024; Python of autumn 2024; Python of autumn 2025.
constexpr JsonRules kNumbered{{0, 0, 1}, false, true, true, false, 1280, 720};
constexpr JsonRules kNamed{{1, 0, 0}, true, false, true, false, 1280, 720};
constexpr JsonRules kNamed2025{{0, 0, 1}, true, false, false, true, 1280, 720};

struct Mark {
    Test test;
    const JsonRules& rules;
};
// The strongest first: the first mark that a scene has decides.
constexpr auto kMarks = std::to_array<Mark>({
    {[](const JsonValue& scene) {
         const JsonValue* camera = scene.find("camera");
         return camera && camera->find("fovy");
     },
     kNamed2025},
    {[](const JsonValue& scene) { return scene.find("AA_samples") || scene.find("AA_jitter"); },
     kNamed},
    {[](const JsonValue& scene) { return scene.find("AA") != nullptr; }, kNumbered},
    {[](const JsonValue& scene) {
         return materialsHave(scene, "ID") || materialsHave(scene, "hardness");
     },
     kNumbered},
    {[](const JsonValue& scene) { return materialsHave(scene, "shininess"); }, kNamed},
    {[](const JsonValue& scene) { return anyObject(scene, hasNumberedMaterials); }, kNumbered},
    {[](const JsonValue& scene) {
         return anyObject(scene, [](const JsonValue& o) { return isOfType(o, "instance"); });
     },
     kNamed},
    {[](const JsonValue& scene) {
         return anyObject(scene, [](const JsonValue& o) { return o.find("ref") != nullptr; });
     },
     kNumbered},
});

} // namespace

JsonRules jsonRulesOf(const JsonValue& scene) {
    const auto* const mark =
        std::find_if(kMarks.begin(), kMarks.end(), [&](const Mark& m) { return m.test(scene); });
    JsonRules rules = mark == kMarks.end() ? kNamed : mark->rules;
    // The program of 2022 asks for both keys of AA. A later scene may have both too; but a scene
    // without 'resolution' and with both is taken for one of 2022.
    const JsonValue* aa = scene.find("AA");
    if (rules.refReplaces && aa && aa->find("jitter") && aa->find("samples")) rules.width = 1080;
    return rules;
}
