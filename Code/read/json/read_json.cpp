#include "read/json/read_json.h"

#include "read/in_parts.h"
#include "read/json/camera.h"
#include "read/json/dialect.h"
#include "read/json/fields.h"
#include "read/json/json.h"
#include "read/json/lights.h"
#include "read/json/materials.h"
#include "read/json/object_list.h"
#include "read/json/problems.h"
#include "read/json/settings.h"

#include <optional>
#include <utility>
#include <vector>

namespace {

// readObjects(what they are read with) gives the objects.
template <class ReadObjects>
SceneDesc readScene(const JsonValue& root, const JsonRules& rules, JsonProblems& problems,
                    const ReadObjects& readObjects) {
    JsonFields scene(root, "the scene", problems);
    SceneDesc desc;
    readJsonSettings(scene, rules, desc.settings);
    const JsonNames textures = readJsonTextures(scene, desc.textures);
    readJsonWorld(scene, textures, desc.world);
    if (const JsonValue* camera = scene.take("camera"))
        desc.cameras.push_back(readJsonCamera(*camera, problems));
    const JsonMaterials materials(scene, textures, desc.materials);
    readJsonLights(scene, rules, desc.lights);
    desc.objects = readObjects(JsonSurroundings{scene, rules, textures, materials, desc.meshes});
    problems.finish();
    return desc;
}

SceneDesc readInOrder(const SourceFile& source, const ReadContext& context) {
    const JsonDocument document = parseJson(source);
    JsonProblems problems(source, context);
    return readScene(document.root, jsonRulesOf(document.root), problems, readJsonObjects);
}

// Nothing when the text has a mistake, when there is anything to say of its objects, when these
// refer to each other, or when they decide what dialect it is.
std::optional<SceneDesc> readInParts(const SourceFile& source, const ReadContext& context,
                                     std::size_t partBytes) {
    const JsonOutline outline = parseJsonOutline(source, "objects", partBytes);
    const JsonValue& root = outline.document.root;
    const auto rules = jsonRulesWithoutObjects(root);
    if (outline.list.parts.empty() || !rules) return {};
    JsonProblems problems(source, context);
    bool isGood = false;
    SceneDesc desc = readScene(root, *rules, problems, [&](const JsonSurroundings& with) {
        auto objects = readJsonObjectsInParts(source, outline.list, context.options.threads, with);
        isGood = objects.has_value();
        return isGood ? std::move(*objects) : std::vector<ObjectDesc>();
    });
    if (!isGood) return {};
    return desc;
}

} // namespace

SceneDesc readJson(const SourceFile& source, const ReadContext& context) {
    constexpr std::size_t kPartBytes = std::size_t{1} << 17;
    return readJson(source, context, kPartBytes);
}

SceneDesc readJson(const SourceFile& source, const ReadContext& context, std::size_t partBytes) {
    // One thread reads in parts, too: a tree of all values takes longer to store than to make.
    return readInPartsOrInOrder(source, context, partBytes, readInParts, readInOrder);
}
