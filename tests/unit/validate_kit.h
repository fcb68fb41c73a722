// What the tests of validate() share: a scene without faults, and what is said of it when changed.
#pragma once

#include "base/text.h"
#include "check.h"
#include "desc/validate.h"

#include <functional>
#include <string>

namespace validate_kit {

// A sound scene: a camera, a light, a sphere, an instance of a triangle with a material.
inline SceneDesc soundScene() {
    SceneDesc desc;
    desc.cameras.emplace_back().name = "camera";
    desc.lights.emplace_back().name = "lamp";
    desc.materials.emplace_back().name = "red";
    MeshDesc& mesh = desc.meshes.emplace_back();
    mesh.name = "mesh";
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    ObjectDesc& instance = desc.objects.emplace_back();
    instance.name = "instance";
    instance.kind = ObjectDesc::Kind::Mesh;
    instance.mesh = 0;
    instance.materials = {0};
    desc.objects.emplace_back().name = "ball";
    return desc;
}

inline std::string errorsOf(const SceneDesc& desc) {
    Diagnostics diagnostics;
    return check::thrown([&] { validate(desc, {"s.json", ""}, diagnostics); });
}
inline std::string errorsAfter(const std::function<void(SceneDesc&)>& damage) {
    SceneDesc desc = soundScene();
    damage(desc);
    return errorsOf(desc);
}
inline std::string warningsAfter(const std::function<void(SceneDesc&)>& change) {
    SceneDesc desc = soundScene();
    change(desc);
    Diagnostics diagnostics;
    validate(desc, {"s.json", ""}, diagnostics);
    return join(diagnostics.warnings, "\n");
}

inline void checkError(const std::string& errors, const std::string& words) {
    CHECK_INFO(errors.find(words) != std::string::npos,
               "expected '" << words << "' in '" << errors << "'");
}

} // namespace validate_kit
