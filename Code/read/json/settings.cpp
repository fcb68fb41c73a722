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

// The rays of a pixel. The programs of 2022 and of winter 2024 read 'AA' with 'samples' n: n x n of
// them, in the middle of the cells of a grid in the pixel, or with 'jitter' anywhere in these.
// Since autumn 2024 'AA_samples' is their number: one in each of so many passes, which without
// 'AA_jitter' all go through the centre of the pixel; below 0 the passes do not end.
struct AntiAliasing {
    int count = 1;
    bool jitter = false;
    bool isGrid = true;
    const JsonValue* given = nullptr;
};
void readPasses(JsonFields& scene, AntiAliasing& aa) {
    constexpr int kMost = 1 << 24, kEndless = 64;
    const JsonValue* samples = scene.read("AA_samples", aa.count, Range{-kMost, kMost});
    const JsonValue* jitter = scene.read("AA_jitter", aa.jitter);
    aa.given = samples ? samples : jitter;
    if (aa.count < 1) {
        aa.count = aa.jitter ? kEndless : 1;
        scene.problems().warn(samples->loc(), [&] {
            return cat("'AA_samples' below 1 renders without end in the course's program; ",
                       aa.count, " per pixel are taken");
        });
    } else if (aa.count > 1 && !aa.jitter) {
        scene.problems().warn(samples->loc(), [&] {
            return cat("without 'AA_jitter' all ", aa.count,
                       " samples go through the centre of the pixel, as in the course's program; "
                       "one is taken");
        });
        aa.count = 1;
    }
    aa.isGrid = !aa.jitter;
}
AntiAliasing readAntiAliasing(JsonFields& scene) {
    AntiAliasing aa;
    readPasses(scene, aa);
    const JsonValue* both = scene.take("AA");
    if (!both) return aa;
    if (aa.given)
        scene.problems().error(
            both->loc(), [] { return "give 'AA', or 'AA_samples' and 'AA_jitter', not both"; });
    JsonFields fields(*both, "'AA'", scene.problems());
    int n = 1;
    fields.read("jitter", aa.jitter);
    fields.read("samples", n, Range{1, 4096}); // 2^24 samples
    fields.reportUnknown();
    aa.count = n * n;
    aa.isGrid = true;
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
    settings.textureFilter = SettingsDesc::TextureFilter::None;
    settings.transfer = SettingsDesc::Transfer::Linear; // the course's programs write no gamma
    const AntiAliasing aa = readAntiAliasing(scene);
    const JsonValue* value = scene.take("settings");
    std::optional<JsonFields> fields;
    if (value) fields.emplace(*value, "'settings'", scene.problems());
    readTopKey(scene, fields ? &*fields : nullptr, "resolution", "settings", settings);
    const JsonValue* samples = fields ? fields->find("samples") : nullptr;
    if (samples && aa.given)
        scene.problems().error(samples->loc(), [] {
            return "'samples' of the settings and AA count the samples of a pixel; give one";
        });
    // A scene that counts all samples of a pixel gets the native pattern for them.
    if (!samples) {
        if (aa.isGrid) settings.sampler = SettingsDesc::Sampler::Grid;
        settings.samplesPerPixel = aa.count;
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
