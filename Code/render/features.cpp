#include "render/features.h"

#include "base/for_each.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>

namespace {

struct Situation {
    const SceneDesc& desc;
    const CameraDesc& camera;
    const RenderSettings& settings;
};

bool isBlack(Rgbd c) { return c == Rgbd{}; }

template <class Test> bool anyMaterial(const Situation& s, Test test) {
    return std::any_of(s.desc.materials.begin(), s.desc.materials.end(), test);
}

bool hasSoftLight(const Situation& s) {
    return std::any_of(s.desc.lights.begin(), s.desc.lights.end(), [](const LightDesc& light) {
        switch (light.kind) {
        case LightDesc::Kind::Point:
        case LightDesc::Kind::Spot: return light.radius > 0;
        case LightDesc::Kind::Sun: return light.angleDeg > 0;
        case LightDesc::Kind::Rectangle:
        case LightDesc::Kind::Disk:
        case LightDesc::Kind::Sphere: break;
        }
        return true;
    });
}

bool moves(const Keys& keys) {
    return std::adjacent_find(keys.begin(), keys.end(), std::not_equal_to<>()) != keys.end();
}

bool hasMotion(const Situation& s) {
    constexpr std::size_t kTogether = 1 << 14;
    std::atomic<bool> has{moves(s.camera.worldFromCamera)};
    forEachPart(s.settings.threads, s.desc.objects.size(), kTogether,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last && !has; ++i)
                        if (moves(s.desc.objects[i].worldFromObject)) has = true;
                });
    return has;
}

// Pictures that nothing uses are not read either.
bool usesTextures(const Situation& s) {
    return s.desc.world.environment != kNone || anyMaterial(s, [](const MaterialDesc& m) {
               const auto handles = {m.diffuseTexture, m.specularTexture, m.emissionTexture,
                                     m.opacityTexture, m.normalMap,       m.bumpMap};
               return std::any_of(handles.begin(), handles.end(),
                                  [](Handle handle) { return handle != kNone; });
           });
}

bool sharesMeshes(const Situation& s) {
    if (s.desc.meshes.empty()) return false;
    std::vector<Handle> meshes;
    for (const ObjectDesc& object : s.desc.objects)
        if (object.kind == ObjectDesc::Kind::Mesh) meshes.push_back(object.mesh);
    std::sort(meshes.begin(), meshes.end());
    return std::adjacent_find(meshes.begin(), meshes.end()) != meshes.end();
}

struct Rule {
    const char* name;
    bool (*isInScene)(const Situation&);
    bool Switches::*on; // nullptr: has no switch of its own
    const char* otherwise;
};

constexpr std::array kRules = std::to_array<Rule>({
    {"shadows",
     [](const Situation& s) {
         return std::any_of(s.desc.lights.begin(), s.desc.lights.end(),
                            [](const LightDesc& l) { return l.shadows; });
     },
     &Switches::shadows, "no light casts shadows"},
    {"soft-shadows", hasSoftLight, &Switches::softShadows, "no light has a size"},
    {"reflection",
     [](const Situation& s) {
         return anyMaterial(s, [](const MaterialDesc& m) { return !isBlack(m.mirror); });
     },
     &Switches::reflection, "no material has mirror"},
    {"refraction",
     [](const Situation& s) {
         return anyMaterial(s, [](const MaterialDesc& m) { return !isBlack(m.transmission); });
     },
     &Switches::refraction, "no material has transmission"},
    {"glossy",
     [](const Situation& s) {
         return anyMaterial(s, [](const MaterialDesc& m) {
             return m.roughness > 0 && (!isBlack(m.mirror) || !isBlack(m.transmission));
         });
     },
     &Switches::glossy, "no mirror or transmission has roughness"},
    {"fresnel",
     [](const Situation& s) {
         return anyMaterial(
             s, [](const MaterialDesc& m) { return m.fresnel != MaterialDesc::Fresnel::None; });
     },
     &Switches::fresnel, "no material asks for it"},
    {"transparency",
     [](const Situation& s) {
         return anyMaterial(
             s, [](const MaterialDesc& m) { return m.opacity < 1 || m.opacityTexture != kNone; });
     },
     nullptr, "all materials are opaque"},
    {"textures", usesTextures, &Switches::textures, "nothing uses one"},
    {"bump",
     [](const Situation& s) {
         return anyMaterial(
             s, [](const MaterialDesc& m) { return m.bumpMap != kNone || m.normalMap != kNone; });
     },
     &Switches::textures, "no bump or normal map"},
    {"environment", [](const Situation& s) { return s.desc.world.environment != kNone; },
     &Switches::textures, "no environment picture"},
    {"dof", [](const Situation& s) { return s.camera.apertureRadius > 0; }, &Switches::dof,
     "aperture_radius is 0"},
    {"motion-blur", hasMotion, &Switches::motionBlur, "nothing moves"},
    {"aa", [](const Situation& s) { return s.settings.picture.samplesPerPixel > 1; }, &Switches::aa,
     "one sample per pixel"},
    {"instances", sharesMeshes, nullptr, "no mesh is used twice"},
});

} // namespace

Features featuresOf(const SceneDesc& desc, const CameraDesc& camera,
                    const RenderSettings& settings) {
    const Situation situation{desc, camera, settings};
    Features features;
    for (const Rule& rule : kRules) {
        const bool inScene = rule.isInScene(situation);
        const bool on = !rule.on || settings.switches.*rule.on;
        features.push_back({rule.name, inScene && on, inScene ? "switched off" : rule.otherwise});
    }
    return features;
}
