#include "scene/make_shapes.h"

#include "base/for_each.h"
#include "desc/enum_tables.h"
#include "desc/validate.h"
#include "scene/features.h"
#include "scene/make_shape.h"
#include "shape/mesh.h"
#include "shape/mesh_instance.h"

#include <algorithm>
#include <utility>

namespace {

constexpr std::size_t kNotShared = static_cast<std::size_t>(-1);

} // namespace

MovingTransform placedKeys(const Keys& keys, const SceneFrame& frame, bool motionBlur) {
    if (keys.size() == 1) return frame.placed(keys.front());
    std::vector<Transform> maps;
    for (const Rows& rows : keys) maps.push_back(frame.placed(rows));
    const MovingTransform moving{std::span<const Transform>(maps)};
    return motionBlur ? moving : MovingTransform(moving.at(0.5));
}

ShapeMaker::ShapeMaker(const SceneDesc& desc, const RenderSettings& settings,
                       const SceneFrame& frame, const std::vector<std::uint8_t>& seeThrough)
    : desc_(desc), settings_(settings), frame_(frame), seeThrough_(seeThrough),
      sharedOf_(desc.meshes.size(), kNotShared) {
    for (const bool isSolid : {true, false})
        for (const auto sides : kValuesOf<ObjectDesc::Sides>)
            merged_.push_back({sides, isSolid, {}, {}, {}});
    // Of millions most are neither meshes nor do they move.
    constexpr std::size_t kTogether = 1 << 12;
    std::vector<std::uint8_t> isPlain(desc_.objects.size());
    forEachPart(settings_.threads, isPlain.size(), kTogether,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i) {
                        const ObjectDesc& object = desc_.objects[i];
                        isPlain[i] = object.kind != ObjectDesc::Kind::Mesh &&
                                     object.worldFromObject.size() == 1;
                    }
                });
    simple_.reserve(desc_.objects.size());
    const std::vector<bool> isCopied = meshesToCopy();
    for (std::uint32_t i = 0; i < desc_.objects.size(); ++i) {
        if (isPlain[i] != 0) {
            simple_.push_back(i);
            continue;
        }
        const ObjectDesc& object = desc_.objects[i];
        const bool isStill = object.worldFromObject.size() == 1 || placeOf(i).isStatic();
        moves_ = moves_ || !isStill;
        if (object.kind != ObjectDesc::Kind::Mesh) {
            simple_.push_back(i);
            continue;
        }
        Placed placed{i, materialsBySlot(object)};
        // Meshes that move or have too many copies are instances.
        const auto mesh = static_cast<std::size_t>(object.mesh);
        placed.isCopied = isCopied[mesh] && isStill && isNear(i);
        if (placed.isCopied) {
            const bool isSolid = shadowOf(placed.materials) == ShapeSet::Shadow::Opaque;
            for (Merged& merged : merged_)
                if (merged.isSolid == isSolid && merged.sides == object.sides)
                    merged.members.push_back(placed_.size());
        } else if (sharedOf_[mesh] == kNotShared) {
            sharedOf_[mesh] = shared_.size();
            shared_.push_back({mesh, nullptr, 0});
        }
        placed_.push_back(std::move(placed));
    }
}

std::vector<std::function<void()>> ShapeMaker::jobs(ShapeSet& shapes) {
    shapes.resize(simple_.size());
    std::vector<std::function<void()>> out;
    for (Merged& merged : merged_)
        if (!merged.members.empty()) out.emplace_back([this, &merged] { merge(merged); });
    for (Shared& shared : shared_) out.emplace_back([this, &shared] { share(shared); });
    constexpr std::size_t kTogether = 4096;
    for (std::size_t first = 0; first < simple_.size(); first += kTogether)
        out.emplace_back([this, &shapes, first] {
            makeSimple(shapes, first, std::min(simple_.size(), first + kTogether));
        });
    return out;
}

// After the other shapes come those with triangles in a row: ShapeSet::isBefore() needs that.
void ShapeMaker::finish(ShapeSet& shapes,
                        std::vector<std::unique_ptr<const MeshGeometry>>& geometries) {
    const auto finishLarge = [&](MeshGeometry& geometry) {
        if (!isBuiltInJob(geometry)) finishTree(geometry, settings_.threads);
    };
    for (Shared& shared : shared_) finishLarge(*shared.geometry);
    for (Merged& merged : merged_)
        if (merged.geometry) finishLarge(*merged.geometry);
    addInstances(shapes);
    for (Shared& shared : shared_) geometries.push_back(std::move(shared.geometry));
    for (Merged& merged : merged_) {
        if (!merged.geometry) continue;
        auto mesh = std::make_unique<Mesh>(*merged.geometry, merged.mesh.materials,
                                           std::move(merged.mesh.parts));
        shapes.add(withSides(std::move(mesh), merged.sides), shadowOf(merged.mesh.materials));
        geometries.push_back(std::move(merged.geometry));
    }
}

// Once for all copies and instances of a mesh, as the first of them has it.
std::uint64_t ShapeMaker::degenerateCount() const {
    std::vector<bool> isCounted(desc_.meshes.size());
    std::uint64_t count = 0;
    for (const Placed& placed : placed_) {
        const auto mesh = static_cast<std::size_t>(desc_.objects[placed.object].mesh);
        if (isCounted[mesh]) continue;
        isCounted[mesh] = true;
        count +=
            placed.isCopied ? placed.degenerateCount : shared_[sharedOf_[mesh]].degenerateCount;
    }
    return count;
}

// The scene's numbers of its materials, at least one; objects without one get the default.
OneOrMore<std::uint32_t> ShapeMaker::materialIds(const ObjectDesc& object) const {
    const auto none = static_cast<std::uint32_t>(desc_.materials.size());
    OneOrMore<std::uint32_t> ids;
    for (const Handle handle : object.materials)
        ids.push_back(handle == kNone ? none : static_cast<std::uint32_t>(handle));
    if (ids.empty()) ids.push_back(none);
    return ids;
}

std::vector<std::uint32_t> ShapeMaker::materialsBySlot(const ObjectDesc& object) const {
    const OneOrMore<std::uint32_t> ids = materialIds(object);
    std::vector<std::uint32_t> out(ids.begin(), ids.end());
    std::uint32_t slots = 1;
    for (const std::uint32_t slot :
         desc_.meshes[static_cast<std::size_t>(object.mesh)].triangleMaterials)
        slots = std::max(slots, slot + 1);
    while (out.size() < slots) out.push_back(out.back());
    return out;
}

ShapeSet::Shadow ShapeMaker::shadowOf(std::span<const std::uint32_t> materials) const {
    const bool seeThrough = std::any_of(materials.begin(), materials.end(),
                                        [&](std::uint32_t m) { return seeThrough_[m] != 0; });
    return seeThrough ? ShapeSet::Shadow::SeeThrough : ShapeSet::Shadow::Opaque;
}

// By mesh: those that are used once, and others as long as there is room for all their copies.
std::vector<bool> ShapeMaker::meshesToCopy() const {
    std::vector<std::uint64_t> uses(desc_.meshes.size(), 0);
    if (uses.empty()) return {};
    for (const ObjectDesc& object : desc_.objects)
        if (object.kind == ObjectDesc::Kind::Mesh) ++uses[static_cast<std::size_t>(object.mesh)];
    std::vector<bool> out(uses.size());
    std::uint64_t room = settings_.copiedTriangles;
    for (std::size_t mesh = 0; mesh < uses.size(); ++mesh) {
        const std::uint64_t triangles = uses[mesh] * desc_.meshes[mesh].triangles.size();
        out[mesh] = uses[mesh] == 1 || triangles <= room;
        if (uses[mesh] > 1 && out[mesh]) room -= triangles;
    }
    return out;
}

MovingTransform ShapeMaker::placeOf(std::uint32_t object) const {
    return placedKeys(desc_.objects[object].worldFromObject, frame_, settings_.switches.motionBlur);
}

// What is distant stays alone, so that the pads of what is merged do not grow.
bool ShapeMaker::isNear(std::uint32_t number) const {
    if (frame_.distantFrom == kInfinityF) return true;
    const ObjectDesc& object = desc_.objects[number];
    const BoundsD box =
        placeOf(number).at(0).bounds(boundsOf(desc_.meshes[static_cast<std::size_t>(object.mesh)]));
    return !isDistant({toFloat(box.lo), toFloat(box.hi)}, frame_.distantFrom);
}

const MeshDesc& ShapeMaker::meshOf(const Placed& placed) const {
    return desc_.meshes[static_cast<std::size_t>(desc_.objects[placed.object].mesh)];
}

void ShapeMaker::finishTree(MeshGeometry& geometry, int threads) const {
    geometry.finish(settings_.accel == AccelKind::Bvh, *settings_.isa, threads);
}

std::size_t ShapeMaker::trees() const {
    const auto merged = std::count_if(merged_.begin(), merged_.end(),
                                      [](const Merged& m) { return !m.members.empty(); });
    return shared_.size() + static_cast<std::size_t>(merged);
}

void ShapeMaker::merge(Merged& merged) {
    for (const std::size_t i : merged.members) {
        Placed& placed = placed_[i];
        const std::uint64_t before = merged.mesh.degenerateCount;
        merged.mesh.add(meshOf(placed), placeOf(placed.object).at(0), placed.materials,
                        placed.object, settings_.threads);
        placed.degenerateCount = merged.mesh.degenerateCount - before;
    }
    if (merged.mesh.geometry.triangles.empty()) return;
    merged.geometry = std::make_unique<MeshGeometry>(std::move(merged.mesh.geometry));
    if (isBuiltInJob(*merged.geometry)) finishTree(*merged.geometry, 1);
}

void ShapeMaker::share(Shared& shared) {
    shared.geometry = std::make_unique<MeshGeometry>(
        toSharedGeometry(desc_.meshes[shared.mesh], settings_.threads));
    shared.degenerateCount = shared.geometry->dropDegenerate(settings_.threads);
    if (isBuiltInJob(*shared.geometry)) finishTree(*shared.geometry, 1);
}

void ShapeMaker::makeSimple(ShapeSet& shapes, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
        const ObjectDesc& object = desc_.objects[simple_[i]];
        const OneOrMore<std::uint32_t> materials = materialIds(object);
        shapes.set(i, makeShape(object, placeOf(simple_[i]), materials, simple_[i]),
                   shadowOf(materials));
    }
}

// One geometry per mesh; as many transforms as there are instances.
void ShapeMaker::addInstances(ShapeSet& shapes) {
    const auto geometryOf = [&](const Placed& placed) -> const MeshGeometry& {
        const auto mesh = static_cast<std::size_t>(desc_.objects[placed.object].mesh);
        return *shared_[sharedOf_[mesh]].geometry;
    };
    std::vector<Placed*> instances;
    for (Placed& placed : placed_)
        if (!placed.isCopied && !geometryOf(placed).triangles.empty()) instances.push_back(&placed);
    const std::size_t before = shapes.shapes.size();
    shapes.resize(before + instances.size());
    constexpr std::size_t kTogether = 64;
    forEachPart(
        settings_.threads, instances.size(), kTogether, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                Placed& placed = *instances[i];
                const ShapeSet::Shadow shadow = shadowOf(placed.materials);
                auto instance =
                    std::make_unique<MeshInstance>(geometryOf(placed), placeOf(placed.object),
                                                   std::move(placed.materials), placed.object);
                shapes.set(before + i,
                           withSides(std::move(instance), desc_.objects[placed.object].sides),
                           shadow);
            }
        });
}
