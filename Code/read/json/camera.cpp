#include "read/json/camera.h"

#include "base/math.h"
#include "read/json/placement.h"
#include "read/json/properties.h"

namespace {

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
