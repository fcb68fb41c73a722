#include "read/json/read_json.h"

#include "read/json/camera.h"
#include "read/json/dialect.h"
#include "read/json/fields.h"
#include "read/json/geometry.h"
#include "read/json/json.h"
#include "read/json/lights.h"
#include "read/json/materials.h"
#include "read/json/objects.h"
#include "read/json/problems.h"
#include "read/json/settings.h"

SceneDesc readJson(const SourceFile& source, const ReadContext& context) {
    const JsonDocument document = parseJson(source);
    JsonProblems problems(source, context);
    JsonFields scene(document.root, "the scene", problems);
    const JsonRules rules = jsonRulesOf(document.root);
    SceneDesc desc;
    readJsonSettings(scene, rules, desc.settings);
    const JsonNames textures = readJsonTextures(scene, desc.textures);
    readJsonWorld(scene, textures, desc.world);
    if (const JsonValue* camera = scene.take("camera"))
        desc.cameras.push_back(readJsonCamera(*camera, problems));
    const JsonMaterials materials(scene, textures, desc.materials);
    readJsonLights(scene, rules, desc.lights);
    const JsonGeometries geometries =
        readJsonGeometries(scene, rules, textures, materials, desc.meshes);
    scene.reportUnknown();
    // A tree with errors could be larger than any memory.
    if (!problems.hasErrors()) desc.objects = flattenJson(geometries, problems);
    problems.finish();
    return desc;
}
