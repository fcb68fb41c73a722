#include "read/json/settings.h"
#include "read/unique_names.h"

#include "base/math.h"
#include "base/text.h"
#include "base/transform.h"
#include "desc/names.h"
#include "read/json/names.h"
#include "read/json/placement.h"
#include "read/json/properties.h"

#include <algorithm>
#include <array>

namespace {

using LightKind = LightDesc::Kind;

struct LightType {
    std::string_view word;
    LightKind kind;
    bool isDirectional = false; // the course's: `direction` points to the light
};
constexpr auto kLightTypes = std::to_array<LightType>({
    {"point", LightKind::Point},
    {"directional", LightKind::Sun, true},
    {"spot", LightKind::Spot},
    {"sun", LightKind::Sun},
    {"rectangle", LightKind::Rectangle},
    {"disk", LightKind::Disk},
    {"sphere", LightKind::Sphere},
    {"area", LightKind::Point}, // in students' programs a point light whose radius softens shadows
});

// nullptr after an error, or when the light is to be skipped.
const LightType* readType(JsonFields& fields) {
    std::string word;
    const JsonValue* value = fields.read("type", word);
    const auto row = std::find_if(kLightTypes.begin(), kLightTypes.end(),
                                  [&](const LightType& t) { return t.word == word; });
    if (row != kLightTypes.end()) return &*row;
    std::vector<std::string> known;
    known.reserve(kLightTypes.size());
    for (const LightType& type : kLightTypes) known.emplace_back(type.word);
    if (!value)
        fields.problems().error(fields.loc(),
                                [&] { return cat("a light needs a 'type': ", join(known)); });
    else if (value->isString())
        fields.problems().error(value->loc(), [&] {
            return cat("unknown type of light ", unknownName(shown(word), known));
        });
    return nullptr;
}

// The course adds diffuse * max(N.L, 0) * colour * power. A surface of that reflectance under the
// irradiance E shows diffuse / pi * E, so E is pi times as much. The lamps with a surface are the
// renderer's own: there colour * power is the radiance of the surface, what it looks like.
double unitOf(LightKind kind) {
    return kind == LightKind::Point || kind == LightKind::Spot || kind == LightKind::Sun ? kPi : 1;
}

void readColor(JsonFields& fields, const LightType& type, const JsonRules& rules,
               LightDesc& light) {
    const auto colour = fields.takeOneOf({"colour", "color"});
    Rgbd color{1, 1, 1};
    if (colour.value) readJsonValue(*colour.value, colour.key, fields.problems(), color, kColor);
    double power = 1;
    fields.read("power", power, kColor);
    if (type.isDirectional && !rules.directionalHasPower) power = 1;
    const double factor = power * unitOf(type.kind);
    light.color = {color.r * factor, color.g * factor, color.b * factor};
}

// Where it is and where it shines, by one of 'direction', 'lookAt' and 'rotation'.
Rows readLightPlace(JsonFields& fields, const LightType& type) {
    JsonPlace place;
    fields.read("position", place.position, kAnyNumber);
    if (type.kind == LightKind::Point || type.kind == LightKind::Sphere)
        return Transform::translate(place.position).rows();

    const auto aim = type.isDirectional ? fields.takeOneOf({"direction"})
                                        : fields.takeOneOf({"direction", "lookAt", "rotation"});
    Vec3d up{0, 1, 0};
    const JsonValue* upValue = type.isDirectional ? nullptr : fields.read("up", up, kAnyNumber);
    Vec3d aimed{0, type.isDirectional ? 1. : -1., 0};
    if (aim.value) {
        const Range& range = aim.key == "rotation" ? kTurn : kAnyNumber;
        if (!readJsonValue(*aim.value, aim.key, fields.problems(), aimed, range))
            return kIdentityRows;
    }
    if (aim.key == "rotation") {
        place.rotationDeg = aimed;
        return rowsOf(place);
    }
    const Vec3d shines = aim.key == "lookAt"  ? aimed - place.position
                         : type.isDirectional ? -aimed
                                              : aimed;
    if (maxAbs(shines) == 0) {
        fields.problems().error(aim.value->loc(), [&] {
            return cat("'", aim.key, "' of ", fields.what(),
                       aim.key == "lookAt" ? " is its own position" : " is 0 0 0");
        });
        return rowsOf(place);
    }
    // Without 'up' a light that shines straight down or up takes another axis instead.
    const Transform turned = Transform::fromRows(
        upValue ? lookingAt({}, shines, up, fields) : Transform::lookAt({}, shines, up).rows());
    return (Transform::translate(place.position) * turned).rows();
}

} // namespace

void readJsonLights(JsonFields& scene, const JsonRules& rules, std::vector<LightDesc>& lights) {
    UniqueNames unique;
    const auto values = scene.list("lights");
    for (const JsonValue& value : values) {
        JsonFields fields(value, "a light", scene.problems());
        if (!value.isObject()) continue;
        const LightType* type = readType(fields);
        if (!type) continue;
        LightDesc& light = lights.emplace_back();
        light.loc = value.loc();
        light.kind = type->kind;
        std::string name;
        fields.read("name", name);
        light.name = unique.of(name.empty() ? cat("light", lights.size()) : name);
        readColor(fields, *type, rules, light);
        light.worldFromLight = readLightPlace(fields, *type);
        if (light.kind == LightKind::Point || light.kind == LightKind::Spot)
            light.attenuation = rules.attenuation;
        readJsonProperties(fields, {}, light, {"type", "color"});
        if (const JsonValue* samples = fields.take("samples"))
            scene.problems().warn(samples->loc(), [] {
                return "'samples' of one light is ignored; 'light_samples' of the settings is for "
                       "all";
            });
        fields.reportUnknown();
    }
    if (lights.empty() && !values.empty())
        scene.problems().warn(values.front().loc(), [] {
            return "no light is left: what does not glow is seen by ambient light alone";
        });
}
