#include "read/nff/scene.h"

#include "base/text.h"
#include "read/added_by_text.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace {

template <class T> void append(RawVector<T>& all, const RawVector<T>& some) {
    all.insert(all.end(), some.begin(), some.end());
}
void append(RawVector<MeshDesc::Corners>& all, const RawVector<MeshDesc::Corners>& some,
            std::size_t firstPoint) {
    const auto first = static_cast<std::uint32_t>(firstPoint);
    for (const auto& [a, b, c] : some) all.push_back({first + a, first + b, first + c});
}

} // namespace

NffScene::NffScene(const SourceFile& source, const ReadContext& context)
    : source_(source), context_(context) {}

bool NffScene::add(NffEntities part, const NffFillHere& readWith) {
    if (std::exchange(isEmpty_, false)) {
        all_ = std::move(part);
        return true;
    }
    if (all_.lastFill.loc.offset != readWith.loc.offset || !takeSingles(part)) return false;
    addLights(part);
    addSurfaces(part);
    for (ObjectDesc& object : part.desc.objects) addObject(part, object);
    all_.lastFill = part.lastFill;
    all_.flatPolygons.add(part.flatPolygons);
    all_.pointSpheres.add(part.pointSpheres);
    all_.flatCones.add(part.flatCones);
    all_.withoutFill.add(part.withoutFill);
    return true;
}

bool NffScene::takeSingles(NffEntities& part) {
    if (part.view != NffWords::kNotGiven) {
        if (all_.view != NffWords::kNotGiven) return false;
        all_.view = part.view;
        all_.desc.cameras = std::move(part.desc.cameras);
        all_.desc.settings = part.desc.settings;
    }
    if (part.background != NffWords::kNotGiven) {
        if (all_.background != NffWords::kNotGiven) return false;
        all_.background = part.background;
        all_.desc.world = part.desc.world;
    }
    return true;
}

void NffScene::addLights(NffEntities& part) {
    std::vector<LightDesc>& lights = all_.desc.lights;
    for (const std::size_t i : part.uncolouredLights)
        all_.uncolouredLights.push_back(lights.size() + i);
    for (LightDesc& light : part.desc.lights) {
        lights.push_back(std::move(light));
        lights.back().name = cat("light", lights.size());
    }
}

void NffScene::addSurfaces(const NffEntities& part) {
    const auto numberOf = [&](const NffEntities::Surface& surface, std::size_t next) {
        const auto number = static_cast<std::uint32_t>(next);
        return surfaceOf_.insert(surface.fill, number).value_or(number);
    };
    if (surfaceOf_.isEmpty())
        for (std::size_t i = 0; i < all_.surfaces.size(); ++i) numberOf(all_.surfaces[i], i);
    surfaces_.clear();
    for (const NffEntities::Surface& surface : part.surfaces) {
        surfaces_.push_back(numberOf(surface, all_.surfaces.size()));
        if (surfaces_.back() == all_.surfaces.size())
            addedByText(all_.surfaces, surface.loc.offset, source_.text.size()) = {surface,
                                                                                   {kNone, kNone}};
    }
}

void NffScene::addObject(NffEntities& part, ObjectDesc& object) {
    const bool hasSurface = !object.materials.empty();
    const auto own = hasSurface ? static_cast<std::size_t>(object.materials.front()) : 0;
    const std::uint32_t inAll = hasSurface ? surfaces_[own] : 0;
    if (hasSurface) object.materials = {static_cast<Handle>(inAll)};
    if (object.kind != ObjectDesc::Kind::Mesh) {
        addNamed(object, 0);
        return;
    }
    const NffEntities::Surface& surface = hasSurface ? part.surfaces[own] : part.noSurface;
    addMesh(object, part.desc.meshes[static_cast<std::size_t>(object.mesh)],
            hasSurface ? all_.surfaces[inAll] : all_.noSurface,
            object.mesh == surface.meshes[0] ? 0 : 1);
}

void NffScene::addMesh(ObjectDesc& object, MeshDesc& mesh, NffEntities::Surface& surface,
                       std::size_t kind) {
    std::vector<MeshDesc>& meshes = all_.desc.meshes;
    Handle& handle = surface.meshes[kind];
    if (handle == kNone) {
        handle = static_cast<Handle>(meshes.size());
        object.mesh = handle;
        mesh.name = addNamed(object, kind).name;
        meshes.push_back(std::move(mesh));
        return;
    }
    MeshDesc& whole = meshes[static_cast<std::size_t>(handle)];
    append(whole.triangles, mesh.triangles, whole.points.size());
    append(whole.normalTriangles, mesh.normalTriangles, whole.points.size());
    append(whole.points, mesh.points);
    append(whole.normals, mesh.normals);
}

ObjectDesc& NffScene::addNamed(ObjectDesc& object, std::size_t meshKind) {
    all_.counts.name(object, meshKind);
    ObjectDesc& added = addedByText(all_.desc.objects, object.loc.offset, source_.text.size());
    return added = std::move(object);
}

SceneDesc NffScene::finish(ErrorList& errors) {
    SceneDesc& desc = all_.desc;
    // Every bounce as far as the benchmark's depth of 5, which counts the eye ray as 1.
    desc.settings.maxDepth = 4;
    desc.settings.cutoff = 0;
    reserveInLargePages(desc.materials, all_.surfaces.size());
    for (const NffEntities::Surface& surface : all_.surfaces) {
        MaterialDesc& material = desc.materials.emplace_back(nffMaterial(surface.fill));
        material.name = cat("fill", desc.materials.size());
        material.loc = surface.loc;
    }
    if (all_.view == NffWords::kNotGiven)
        errors.add({}, [] { return "the file has no view; expected 'v' and its lines"; });
    const double intensity = nffIntensity(desc.lights.size());
    desc.world.ambient = {intensity, intensity, intensity};
    for (const std::size_t i : all_.uncolouredLights) {
        Rgbd& color = desc.lights[i].color;
        color = {color.r * intensity, color.g * intensity, color.b * intensity};
    }
    warn(all_.flatPolygons, "polygon without an area was", "polygons without an area were");
    warn(all_.pointSpheres, "sphere of radius 0 was", "spheres of radius 0 were");
    warn(all_.flatCones, "cone without height or radius was",
         "cones without height or radius were");
    if (all_.withoutFill.count > 0)
        context_.warn(source_, all_.withoutFill.first,
                      "there is no fill ('f') before this; it is grey");
    return std::move(desc);
}

void NffScene::warn(const NffLeftOut& leftOut, std::string_view one, std::string_view many) const {
    if (leftOut.count == 0) return;
    context_.warn(source_, leftOut.first,
                  leftOut.count == 1
                      ? cat("a ", one, " left out")
                      : cat(leftOut.count, " ", many, " left out; this is the first"));
}
