#include "read/json/settings.h"

#include "base/math.h"
#include "read/json/placement.h"
#include "read/json/properties.h"

#include <optional>

namespace {

// A key of the scene itself that is a property of one of its blocks too: one place for it only.
template <class Block>
void readTopKey(JsonFields& scene, const JsonFields* inner, std::string_view keyword,
                std::string_view innerName, Block& block) {
    const JsonValue* value = scene.take(keyword);
    if (!value) return;
    if (inner && inner->has(keyword))
        scene.problems().error(value->loc(), [&] {
            return cat("'", keyword, "' is given here and in '", innerName, "'; keep one of them");
        });
    readJsonProperty(*value, propertyNamed(Block::kType, keyword), {}, scene.problems(), &block);
}

// n x n samples in the cells of a grid in the pixel, in the middle of each cell or anywhere in it.
struct AntiAliasing {
    int n = 1;
    bool jitter = false;
    const JsonValue* given = nullptr;
};
AntiAliasing readAntiAliasing(JsonFields& scene) {
    constexpr Range kGrid{1, 4096}; // 2^24 samples
    AntiAliasing aa;
    aa.given = scene.read("AA_samples", aa.n, kGrid);
    const JsonValue* jitter = scene.read("AA_jitter", aa.jitter);
    if (!aa.given) aa.given = jitter;
    const JsonValue* both = scene.take("AA");
    if (!both) return aa;
    if (aa.given)
        scene.problems().error(
            both->loc(), [] { return "give 'AA', or 'AA_samples' and 'AA_jitter', not both"; });
    JsonFields fields(*both, "'AA'", scene.problems());
    fields.read("jitter", aa.jitter);
    fields.read("samples", aa.n, kGrid);
    fields.reportUnknown();
    aa.given = both;
    return aa;
}

struct View {
    Vec3d position{0, 0, 0}, lookAt{0, 0, 0}, up{0, 1, 0};
};

void readView(JsonFields& fields, View& view) {
    fields.read("position", view.position, kAnyNumber);
    fields.read("lookAt", view.lookAt, kAnyNumber);
    fields.read("up", view.up, kAnyNumber);
}

// Half the sensor's height over the lens is the tangent of half the vertical angle.
void readAngle(JsonFields& fields, CameraDesc& camera) {
    constexpr double kUsualDeg = 45;
    double fovDeg = kUsualDeg;
    const auto fov = fields.takeOneOf({"fov", "fovy"});
    const JsonValue* lens = fields.find("lens");
    if (fov.value && lens)
        fields.problems().error(lens->loc(),
                                [&] { return cat("give '", fov.key, "' or 'lens', not both"); });
    if (fov.value) {
        readJsonValue(*fov.value, fov.key, fields.problems(), fovDeg, {0, 179.999, true});
        if (camera.sensorFit != CameraDesc::SensorFit::Vertical)
            fields.problems().error(fov.value->loc(), [&] {
                return cat("'", fov.key,
                           "' is the vertical angle; with another 'sensor_fit' give 'lens'");
            });
    }
    if (!lens && camera.sensorFit == CameraDesc::SensorFit::Vertical)
        camera.lensMm = camera.sensorHeightMm / (2 * exact::tan(radians(fovDeg) / 2));
}

} // namespace

void readJsonSettings(JsonFields& scene, const JsonRules& rules, SettingsDesc& settings) {
    settings.loc = scene.loc();
    settings.width = rules.width;
    settings.height = rules.height;
    settings.filter = SettingsDesc::Filter::Box;
    settings.filterWidth = 1;
    settings.transfer = SettingsDesc::Transfer::Linear; // the course's programs write no gamma
    const AntiAliasing aa = readAntiAliasing(scene);
    const JsonValue* value = scene.take("settings");
    std::optional<JsonFields> fields;
    if (value) fields.emplace(*value, "'settings'", scene.problems());
    readTopKey(scene, fields ? &*fields : nullptr, "resolution", "settings", settings);
    const JsonValue* samples = fields ? fields->find("samples") : nullptr;
    if (samples && aa.given)
        scene.problems().error(samples->loc(), [] {
            return "'samples' counts all samples of a pixel, and AA those of a row; give one";
        });
    // A scene that counts samples in the native way gets the native pattern for them.
    if (!samples) {
        settings.sampler = SettingsDesc::Sampler::Grid;
        settings.samplesPerPixel = aa.n * aa.n;
        settings.jitter = aa.jitter;
    }
    if (!fields) return;
    settings.loc = value->loc();
    readJsonProperties(*fields, {}, settings);
    fields->reportUnknown();
}

void readJsonWorld(JsonFields& scene, const JsonNames& textures, WorldDesc& world) {
    world.loc = scene.loc();
    world.ambient = {0.1, 0.1, 0.1};
    world.environmentUp = WorldDesc::Up::Y;
    const JsonValue* value = scene.take("world");
    std::optional<JsonFields> fields;
    if (value) fields.emplace(*value, "'world'", scene.problems());
    readTopKey(scene, fields ? &*fields : nullptr, "ambient", "world", world);
    if (!fields) return;
    world.loc = value->loc();
    // A picture is multiplied by the background: alone it shows as it is.
    if (fields->has("environment")) world.background = {1, 1, 1};
    readJsonProperties(*fields, textures, world);
    fields->reportUnknown();
}

CameraDesc readJsonCamera(const JsonValue& value, JsonProblems& problems) {
    JsonFields fields(value, "the camera", problems);
    CameraDesc camera;
    camera.loc = value.loc();
    camera.name = "camera";
    camera.sensorFit = CameraDesc::SensorFit::Vertical;
    fields.read("name", camera.name);
    camera.worldFromCamera =
        readJsonKeys<View>(fields, readView, [](const View& view, const JsonFields& where) {
            return lookingAt(view.position, view.lookAt, view.up, where);
        });
    readJsonProperties(fields, {}, camera);
    readAngle(fields, camera);
    fields.reportUnknown();
    return camera;
}
