#include "scene/features.h"

#include "base/for_each.h"
#include "desc/lobes.h"
#include "material/lobe_types.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>

namespace {

// What a material may have.
enum Trait : unsigned {
    Mirror = 1,
    Transmission = 2,
    Roughness = 4, // of one of these
    Fresnel = 8,
    Transparency = 16,
    Bump = 32,
    Pictures = 64
};

struct Situation {
    const SceneDesc& desc;
    const CameraDesc& camera;
    const RenderSettings& settings;
    unsigned traits; // of all materials

    bool anyMaterial(Trait trait) const { return (traits & trait) != 0; }
};

bool isBlack(Rgbd c) { return c == Rgbd{}; }

unsigned traitsOf(const MaterialDesc& m) {
    const auto trait = [](bool has, Trait which) { return has ? unsigned{which} : 0; };
    const auto isThere = [](Handle handle) { return handle != kNone; };
    const auto pictures = {m.diffuseTexture, m.specularTexture, m.emissionTexture,
                           m.opacityTexture, m.normalMap,       m.bumpMap};
    const bool mirrors = !isBlack(m.mirror), transmits = !isBlack(m.transmission);
    unsigned lobes = 0;
    for (const LobeDesc& lobe : m.lobes) {
        const LobeType& type = lobeTypes()[lobe.kind];
        // What answers lights is rough, as far as its roughness isn't 0.
        bool isRough = (type.flags & kAnswersLights) != 0;
        for (const LobeFieldForm& field : lobeForms()[lobe.kind].fields)
            if (field.name == "roughness") isRough = lobe.numbers[field.first] > 0;
        const bool reflects = type.isMirror() || type.isGlass();
        lobes |= trait(reflects, Mirror) | trait(type.isGlass(), Transmission) |
                 trait(reflects && isRough, Roughness) | trait(!lobe.factors.empty(), Pictures);
    }
    return lobes | trait(mirrors, Mirror) | trait(transmits, Transmission) |
           trait(m.roughness > 0 && (mirrors || transmits), Roughness) |
           trait(m.fresnel != MaterialDesc::Fresnel::None, Fresnel) |
           trait(m.opacity < 1 || isThere(m.opacityTexture), Transparency) |
           trait(isThere(m.bumpMap) || isThere(m.normalMap), Bump) |
           trait(std::any_of(pictures.begin(), pictures.end(), isThere), Pictures);
}

// One pass: where there are hundreds of thousands they lie in slow memory.
unsigned traitsOf(const std::vector<MaterialDesc>& materials, int threads) {
    constexpr std::size_t kTogether = 1 << 12;
    std::atomic<unsigned> all{0};
    forEachPart(threads, materials.size(), kTogether, [&](std::size_t first, std::size_t last) {
        unsigned part = 0;
        for (std::size_t i = first; i < last; ++i) part |= traitsOf(materials[i]);
        all |= part;
    });
    return all;
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
    constexpr std::size_t kTogether = 1 << 12;
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
    return s.desc.world.environment != kNone || s.anyMaterial(Pictures);
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
    {"reflection", [](const Situation& s) { return s.anyMaterial(Mirror); }, &Switches::reflection,
     "no material has mirror"},
    {"refraction", [](const Situation& s) { return s.anyMaterial(Transmission); },
     &Switches::refraction, "no material has transmission"},
    {"glossy", [](const Situation& s) { return s.anyMaterial(Roughness); }, &Switches::glossy,
     "no mirror or transmission has roughness"},
    {"fresnel", [](const Situation& s) { return s.anyMaterial(Fresnel); }, &Switches::fresnel,
     "no material asks for it"},
    {"transparency", [](const Situation& s) { return s.anyMaterial(Transparency); }, nullptr,
     "all materials are opaque"},
    {"textures", usesTextures, &Switches::textures, "nothing uses one"},
    {"bump", [](const Situation& s) { return s.anyMaterial(Bump); }, &Switches::textures,
     "no bump or normal map"},
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
    const Situation situation{desc, camera, settings, traitsOf(desc.materials, settings.threads)};
    Features features;
    for (const Rule& rule : kRules) {
        const bool inScene = rule.isInScene(situation);
        const bool on = !rule.on || settings.switches.*rule.on;
        features.push_back({rule.name, inScene && on, inScene ? "switched off" : rule.otherwise});
    }
    return features;
}
