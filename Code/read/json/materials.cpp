#include "read/json/materials.h"
#include "read/unique_names.h"

#include "base/math.h"
#include "base/text.h"
#include "desc/names.h"
#include "read/json/properties.h"

#include <cmath>
#include <optional>

namespace {

// Doubles count by ones up to there.
std::optional<std::int64_t> idIn(const JsonValue& value) {
    const double number = value.number();
    if (!value.isNumber() || number != std::floor(number) || std::fabs(number) > 0x1p53) return {};
    return static_cast<std::int64_t>(number);
}

// In JSON a material gets specular * (N.H)^exponent times the colour of a light whose irradiance is
// pi times its colour (lights.cpp). The normalised lobe is a reflectance and stays.
void convertSpecular(MaterialDesc& material) {
    if (material.specularModel == MaterialDesc::SpecularModel::Ashikhmin) return;
    material.specular.r *= kInvPi;
    material.specular.g *= kInvPi;
    material.specular.b *= kInvPi;
}

// The course never turns normals to the eye. What it does not have, light passes through or comes
// back from, shows its inside as well.
bool isOfTheCourse(const MaterialDesc& m) {
    return m.mirror == Rgbd{} && m.transmission == Rgbd{} && m.opacity == 1 &&
           m.opacityTexture == kNone && m.lobes.empty();
}

// Empty when there is none.
std::string faultOf(const TextureDesc& texture, const JsonNames& names) {
    const auto isGood = [](std::string_view text) {
        return !text.empty() && findBadText(text) == std::string_view::npos;
    };
    if (!isGood(texture.name)) return "a texture needs a 'name', without control characters";
    if (!isGood(texture.file)) return "a texture needs a 'file', without control characters";
    if (names.find(texture.name) == kNone) return "";
    return cat("another texture is named '", texture.name, "' already; that one is meant");
}

} // namespace

JsonNames readJsonTextures(JsonFields& scene, std::vector<TextureDesc>& textures) {
    JsonNames names;
    for (const JsonValue& value : scene.list("textures")) {
        JsonFields fields(value, "a texture", scene.problems());
        TextureDesc texture;
        texture.loc = value.loc();
        fields.read("name", texture.name);
        if (const JsonValue* file = fields.find("file")) texture.fileLoc = file->loc();
        readJsonProperties(fields, {}, texture);
        fields.reportUnknown();
        std::string fault = value.isObject() ? faultOf(texture, names) : "";
        if (!fault.empty()) scene.problems().error(value.loc(), [&] { return fault; });
        // One that validate() would refuse; of errors more need not be said.
        if (scene.problems().isLenient() && (!fault.empty() || !value.isObject())) continue;
        names.add(texture.name, static_cast<Handle>(textures.size()));
        textures.push_back(std::move(texture));
    }
    return names;
}

JsonMaterials::JsonMaterials(JsonFields& scene, const JsonNames& textures,
                             std::vector<MaterialDesc>& out) {
    UniqueNames unique;
    JsonProblems& problems = scene.problems();
    for (const JsonValue& value : scene.list("materials")) {
        const auto handle = static_cast<Handle>(out.size());
        JsonFields fields(value, "a material", problems);
        MaterialDesc& material = out.emplace_back();
        material.loc = value.loc();
        material.exponent = 0; // the course's
        const bool saysLitSide = fields.find("lit_side") != nullptr;
        std::string name;
        const JsonValue* nameValue = fields.read("name", name);
        if (const JsonValue* id = fields.take("ID")) addId(*id, handle, problems);
        if (name.empty())
            name = cat("material", out.size());
        else if (!names_.add(name, handle))
            problems.warn(nameValue->loc(), [&] {
                return cat("another material is named '", shown(name),
                           "' already; that one is meant by the name");
            });
        material.name = unique.of(name);
        const auto exponent = fields.takeOneOf({"hardness", "shininess", "exponent"});
        if (exponent.value)
            readJsonValue(*exponent.value, exponent.key, problems, material.exponent, {0, 1e9});
        readJsonLobes(fields, textures, material);
        readJsonProperties(fields, textures, material, {"exponent"});
        convertSpecular(material);
        if (!saysLitSide && isOfTheCourse(material))
            material.litSide = MaterialDesc::LitSide::Outside;
        fields.reportUnknown();
    }
}

void JsonMaterials::addId(const JsonValue& value, Handle handle, JsonProblems& problems) {
    const auto id = idIn(value);
    if (!id)
        return problems.error(value.loc(), [&] {
            return cat("expected a whole number for 'ID', got ", described(value));
        });
    if (!ids_.try_emplace(*id, handle).second)
        problems.warn(value.loc(), [&] {
            return cat("another material has the ID ", *id, " already; that one is meant by it");
        });
}

Handle JsonMaterials::find(const JsonValue& value, JsonProblems& problems) const {
    if (value.isString()) {
        const Handle handle = names_.find(std::string(value.text()));
        if (handle == kNone)
            problems.warn(value.loc(), [&] {
                return cat("unknown material ", unknownName(shown(value.text()), names_.known()),
                           "; it is left out");
            });
        return handle;
    }
    const auto id = idIn(value);
    if (!id) {
        problems.error(value.loc(), [&] {
            return cat("expected the ID or the name of a material, got ", described(value));
        });
        return kNone;
    }
    const auto found = ids_.find(*id);
    if (found != ids_.end()) return found->second;
    problems.warn(value.loc(),
                  [&] { return cat("no material has the ID ", *id, "; it is left out"); });
    return kNone;
}

std::vector<Handle> JsonMaterials::of(JsonFields& object) const {
    std::vector<Handle> handles;
    const auto add = [&](const JsonValue& value) {
        if (const Handle handle = find(value, object.problems()); handle != kNone)
            handles.push_back(handle);
    };
    const auto given = object.takeOneOf({"materials", "material"});
    if (!given.value) return handles;
    if (given.key == "material") {
        add(*given.value);
        return handles;
    }
    if (!given.value->isArray()) {
        object.problems().error(given.value->loc(), [&] {
            return cat("expected an array for 'materials', got ", described(*given.value));
        });
        if (given.value->isString() || given.value->isNumber()) add(*given.value);
    }
    for (const JsonValue& value : given.value->items()) add(value);
    return handles;
}
