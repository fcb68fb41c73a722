#include "read/json/placement.h"

#include "base/math.h"
#include "base/transform.h"

#include <algorithm>

namespace {

void readPlace(JsonFields& fields, JsonPlace& place) {
    fields.read("position", place.position, kAnyNumber);
    fields.read("rotation", place.rotationDeg, kTurn);
    const JsonValue* scale = fields.take("scale");
    double factor = 1;
    if (!scale) return;
    if (!scale->isNumber())
        readJsonValue(*scale, "scale", fields.problems(), place.scale, kAnyNumber);
    else if (readJsonValue(*scale, "scale", fields.problems(), factor, kAnyNumber))
        place.scale = {factor, factor, factor};
}

} // namespace

Rows rowsOf(const JsonPlace& place) {
    // What is not there is not multiplied: most things only stand somewhere.
    Transform turned;
    const auto turn = [&](Vec3d axis, double angleDeg) {
        if (angleDeg != 0) turned = turned * Transform::rotate(axis, radians(angleDeg));
    };
    turn({1, 0, 0}, place.rotationDeg.x);
    turn({0, 1, 0}, place.rotationDeg.y);
    turn({0, 0, 1}, place.rotationDeg.z);
    const Vec3d &s = place.scale, &t = place.position;
    const Rows& r = turned.rows();
    return {r[0] * s.x, r[1] * s.y, r[2] * s.z, t.x,        r[4] * s.x,  r[5] * s.y,
            r[6] * s.z, t.y,        r[8] * s.x, r[9] * s.y, r[10] * s.z, t.z};
}

Keys readJsonPlace(JsonFields& fields, Rows (*rows)(const JsonPlace&)) {
    return readJsonKeys<JsonPlace>(
        fields, readPlace, [&](const JsonPlace& place, const JsonFields&) { return rows(place); });
}

Rows lookingAt(Vec3d eye, Vec3d target, Vec3d up, const JsonFields& fields) {
    const auto error = [&](std::string_view key, std::string_view what) {
        const JsonValue* value = fields.find(key);
        fields.problems().error(value ? value->loc() : fields.loc(),
                                [&] { return cat("'", key, "' of ", fields.what(), " ", what); });
    };
    const Vec3d view = target - eye;
    if (maxAbs(view) == 0) {
        error("lookAt", "is its own position");
        return Transform::lookAt(eye, eye - Vec3d{0, 0, 1}, {0, 1, 0}).rows();
    }
    if (maxAbs(up) == 0) error("up", "has no direction");
    // Within 1e-10 radians of each other, rounding would decide the roll.
    else if (length(cross(normalize(up / maxAbs(up)), normalize(view / maxAbs(view)))) <= 1e-10)
        error("up", "is parallel to the view; choose another, such as [0, 0, 1]");
    return Transform::lookAt(eye, target, up).rows();
}

Keys product(const Keys& a, const Keys& b) {
    if (a.size() != b.size() && a.size() != 1 && b.size() != 1) return {};
    Keys keys(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const Rows& left = a[a.size() == 1 ? 0 : i];
        const Rows& right = b[b.size() == 1 ? 0 : i];
        // A product with the identity could lose the sign of a zero.
        keys[i] = left == kIdentityRows ? right
                  : right == kIdentityRows
                      ? left
                      : (Transform::fromRows(left) * Transform::fromRows(right)).rows();
    }
    return keys;
}
