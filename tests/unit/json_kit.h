// What the tests of scenes in JSON share: reading one, and comparing what it has.
#pragma once

#include "base/math.h"
#include "base/text.h"
#include "base/transform.h"
#include "check.h"
#include "read/json/read_json.h"

#include <string>
#include <utility>
#include <vector>

namespace json_kit {

struct Reading {
    SceneDesc desc;
    std::vector<std::string> warnings;
};
inline Reading read(const std::string& text, bool lenient = false) {
    const SourceFile source{"t.json", text};
    Diagnostics diagnostics;
    ReadOptions options;
    options.lenient = lenient;
    SceneDesc desc = readJson(source, {options, diagnostics});
    return {std::move(desc), std::move(diagnostics.warnings)};
}
inline SceneDesc scene(const std::string& text) { return read(text).desc; }
// A scene of these objects, with materials a and b of the IDs 0 and 1.
inline const std::string kMaterials =
    R"("materials": [{"name": "a", "ID": 0, "hardness": 1}, {"name": "b", "ID": 1}],)";
inline Reading readObjects(const std::string& objects) {
    return read(cat("{", kMaterials, "\"objects\": [", objects, "]}"));
}
inline std::vector<ObjectDesc> objects(const std::string& text) {
    return readObjects(text).desc.objects;
}

inline Vec3d worldPoint(const ObjectDesc& object, Vec3d p) {
    return Transform::fromRows(object.worldFromObject.at(0)).point(p);
}
inline void checkPoint(Vec3d got, Vec3d expected, double tolerance = 1e-12) {
    CHECK_NEAR(got.x, expected.x, tolerance);
    CHECK_NEAR(got.y, expected.y, tolerance);
    CHECK_NEAR(got.z, expected.z, tolerance);
}
inline void checkColor(Rgbd got, Rgbd expected) {
    checkPoint({got.r, got.g, got.b}, {expected.r, expected.g, expected.b}, 1e-15);
}
inline bool hasWarning(const Reading& reading, const std::string& words) {
    return join(reading.warnings, "\n").find(words) != std::string::npos;
}

} // namespace json_kit
