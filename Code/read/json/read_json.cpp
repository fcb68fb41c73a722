#include "read/json/read_json.h"

#include "read/json/json.h"
#include "read/json/materials.h"
#include "read/json/objects.h"
#include "read/json/settings.h"

#include <vector>

namespace {

// The list "objects"; of the scene's keys it is the last one.
std::vector<ObjectDesc> readObjects(JsonFields& scene, JsonGeometryReader& reader) {
    const auto objects = scene.list("objects");
    reader.reserve(objects.size());
    std::vector<std::size_t> roots;
    for (const JsonValue& object : objects)
        if (const auto root = reader.addRoot(object)) roots.push_back(*root);
    scene.reportUnknown();
    // A tree with errors could be larger than any memory.
    if (scene.problems().hasErrors()) return {};
    JsonObjects list(scene.problems(), roots.size());
    for (const std::size_t root : roots) list.addRoot(reader.all(), root);
    return list.take();
}

// As JSON, and where it is none as JSON5, which the course's programs read since autumn 2024.
JsonDocument parsed(const SourceFile& source, bool isLenient) {
    if (isLenient) return parseJson(source, JsonGrammar::Lenient);
    try {
        return parseJson(source);
    } catch (const Error&) {
        return parseJson(source, JsonGrammar::Json5);
    }
}

} // namespace

SceneDesc readJson(const SourceFile& source, const ReadContext& context) {
    const JsonDocument document = parsed(source, context.options.lenient);
    const JsonRules rules = jsonRulesOf(document.root);
    JsonProblems problems(source, context);
    for (const JsonLiberty& liberty : document.liberties)
        problems.warn(liberty.loc, [&] { return liberty.what; });
    JsonFields scene(document.root, "the scene", problems);
    SceneDesc desc;
    readJsonSettings(scene, rules, desc.settings);
    const JsonNames textures = readJsonTextures(scene, desc.textures);
    readJsonWorld(scene, textures, desc.world);
    if (const JsonValue* camera = scene.take("camera"))
        desc.cameras.push_back(readJsonCamera(*camera, problems));
    const JsonMaterials materials(scene, textures, desc.materials);
    readJsonLights(scene, rules, desc.lights);
    JsonGeometryReader reader(problems, rules, textures, materials, desc.meshes);
    desc.objects = readObjects(scene, reader);
    problems.finish();
    return desc;
}
