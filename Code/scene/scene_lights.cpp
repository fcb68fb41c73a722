#include "scene/scene_lights.h"

#include "base/text.h"
#include "desc/validate.h"
#include "light/kinds/triangle.h"
#include "scene/frame.h"
#include "scene/light_rows.h"
#include "scene/make_shapes.h"
#include "texture/environment.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace {

// Whether rays can meet the lamp.
bool hasSize(const LightDesc& desc) {
    using enum LightDesc::Kind;
    if (desc.kind == Sun) return desc.angleDeg > 0;
    return desc.kind == Rectangle || desc.kind == Disk || desc.kind == Sphere || desc.radius > 0;
}

std::uint8_t seenBy(LightDesc::SeenBy by) {
    using enum LightDesc::SeenBy;
    std::uint8_t bits = 0;
    if (by == Camera || by == All) bits |= PathLights::kSeesAsCamera;
    if (by == Reflections || by == All) bits |= PathLights::kSeesAsReflection;
    return bits;
}

// Whitted pictures with more lights than that get a warning that says what would be faster.
constexpr std::size_t kManyLights = 256;

} // namespace

SceneLights::SceneLights(const SceneDesc& desc, const SceneFrame& frame,
                         const RenderSettings& settings)
    : desc_(desc), frame_(frame), settings_(settings),
      isPath_(settings.picture.integrator == IntegratorKind::Path) {}

void SceneLights::keepObjects() {
    for (std::uint32_t i = 0; i < desc_.objects.size(); ++i) {
        const ObjectDesc& object = desc_.objects[i];
        for (const Handle number : object.materials) {
            if (number == kNone) continue;
            const MaterialDesc& material = desc_.materials[static_cast<std::size_t>(number)];
            const Rgb radiance = toRgb(material.emission);
            if (!(isPath_ || material.emissionLights) || isBlack(radiance)) continue;
            if (!keepObject(i, material, radiance) && !isPath_ && unlit_.count++ == 0)
                unlit_.name = object.name, unlit_.offset = object.loc.offset;
            if (object.kind != ObjectDesc::Kind::Mesh) break; // the second is that of its checker
        }
    }
}

bool SceneLights::keepObject(std::uint32_t number, const MaterialDesc& material, Rgb radiance) {
    const ObjectDesc& object = desc_.objects[number];
    // What does not shine alike everywhere is found by rays alone.
    if (material.emissionTexture != kNone || material.opacity < 1 ||
        material.opacityTexture != kNone)
        return false;
    if (object.kind == ObjectDesc::Kind::Mesh) return true; // addTriangles() does it
    const MovingTransform place =
        placedKeys(object.worldFromObject, frame_, settings_.switches.motionBlur);
    if (object.sides != ObjectDesc::Sides::Both || !place.isStatic()) return false;
    const bool bothSides = material.emissionSides == MaterialDesc::Sides::Both;
    const auto front = makeEmitterRow(object, place.at(0), radiance, false);
    const auto back = makeEmitterRow(object, place.at(0), radiance, true);
    if (front) objects_.push_back({number, false, bothSides && !back, *front});
    if (back && bothSides) objects_.push_back({number, true, false, *back});
    return front.has_value();
}

std::vector<std::string> SceneLights::addTo(PathLights& lights, const Surroundings& around,
                                            const SourceFile& source) const {
    std::vector<std::string> warnings = addLamps(lights, around, source);
    addSky(lights, around);
    for (const ShiningObject& shining : objects_) {
        const std::uint32_t light = lights.add(surfaceEntry(shining.row));
        lights.addObject(shining.object, !shining.back, light);
        if (shining.bothSides) lights.addObject(shining.object, shining.back, light);
    }
    addTriangles(lights, around);
    if (unlit_.count > 0)
        warnings.push_back(located(
            source, unlit_.offset,
            cat("object ", unlit_.name,
                unlit_.count > 1 ? cat(" and ", unlit_.count - 1, " more") : std::string(),
                " shines, but lights nothing here: whitted takes samples of spheres, disks, "
                "rectangles and meshes that stand still and shine alike everywhere; integrator "
                "path would be right"),
            "warning"));
    if (isPath_)
        lights.makeTree();
    else if (lights.size() > kManyLights)
        warnings.push_back(located(
            source, 0,
            cat("this picture takes samples of each of ", lights.size(),
                " lights at every point; integrator path, which chooses among them, would be "
                "faster"),
            "warning"));
    return warnings;
}

std::vector<std::string> SceneLights::addLamps(PathLights& lights, const Surroundings& around,
                                               const SourceFile& source) const {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < desc_.lights.size(); ++i) {
        const LightDesc& desc = desc_.lights[i];
        const LightRow row = lightRow(desc, frame_);
        if (boundsOf(row).isDark()) {
            if (!isBlack(toRgb(desc.color)) && !hasNoArea(desc))
                warnings.push_back(
                    located(source, desc.loc.offset,
                            cat("light ", desc.name,
                                " has no area and lights nothing; sides or a radius above 0 would "
                                "be right"),
                            "warning"));
            continue;
        }
        const bool isSoft = hasSize(desc) && settings_.switches.softShadows;
        const std::uint32_t light =
            lights.add({.row = row,
                        .isOpen = !(desc.shadows && settings_.switches.shadows),
                        .isSoft = isSoft,
                        .isSurface = isPath_ && around.hasBody[i],
                        .inCentre = !settings_.switches.softShadows,
                        .isPlace = !isSoft && desc.kind != LightDesc::Kind::Sun,
                        .place = toFloat(frame_.placed(desc.worldFromLight).point({}))});
        if (!hasSize(desc)) continue;
        if (around.hasBody[i])
            lights.addObject(around.objects + static_cast<std::uint32_t>(i), true, light);
        else
            lights.addUnshaped(light, seenBy(desc.seenBy));
    }
    return warnings;
}

// An even sky is left to the lobes of paths, which find it everywhere.
void SceneLights::addSky(PathLights& lights, const Surroundings& around) const {
    if (!skyLights() || isBlack(around.background) || (around.environment == nullptr && isPath_))
        return;
    const bool isOpen = !settings_.switches.shadows;
    lights.addSky(around.environment != nullptr
                      ? skyTableOf(*around.environment, isPath_ && !isOpen, settings_.threads)
                      : SkyTable(),
                  {around.environment, around.background},
                  static_cast<double>(luminance(around.background)), isOpen);
}

void SceneLights::addTriangles(PathLights& lights, const Surroundings& around) const {
    const auto shines = [&](const SceneMaterial& of) {
        return (isPath_ || of.lightsOthers) && !isBlack(of.emission) && !of.pictures->emission &&
               !of.isLamp && !of.seeThrough();
    };
    if (std::none_of(around.materials.begin(), around.materials.end(), shines)) return;
    for (std::uint32_t shape = 0; shape < around.shapes.shapes.size(); ++shape)
        around.shapes.shapes[shape]->forEachTriangle([&](std::uint32_t triangle,
                                                         const std::array<Vec3, 3>& corners,
                                                         std::uint32_t material) {
            const SceneMaterial& of = around.materials[material];
            if (!shines(of)) return;
            const TriangleRow row{corners[0], corners[1], corners[2], of.emission,
                                  of.emitsFront ? 0.0f : 1.0f};
            lights.addTriangle(shape, triangle, lights.add(surfaceEntry(lightRow(row))));
        });
}

PathLights::Entry SceneLights::surfaceEntry(const LightRow& row) const {
    return {.row = row, .isOpen = !settings_.switches.shadows, .isSoft = true, .isSurface = true};
}

SkyTable skyTableOf(const Environment& environment, bool compensated, int threads) {
    const SkyCells cells = skyCells(environment, kMostSkyColumns, kMostSkyRows, threads);
    return {cells.width, cells.height, cells.luminance, compensated, environment.place(), threads};
}
