#include "read/json/objects.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/json/placement.h"

#include <algorithm>
#include <utility>

namespace {

constexpr std::size_t kLongestPath = 200;
constexpr std::size_t kLargest = std::size_t{1} << 22;

using Handles = std::span<const Handle>;

// What is handed down may be more than a shape can show.
Handles usable(const JsonGeometry& geometry, Handles materials) {
    if (!geometry.shape || geometry.shape->kind == ObjectDesc::Kind::Mesh) return materials;
    const std::size_t most = geometry.shape->kind == ObjectDesc::Kind::InfinitePlane ? 2 : 1;
    return materials.first(std::min(most, materials.size()));
}
const Keys& placeOf(const JsonGeometry& geometry, Handles materials) {
    const bool isCheckerboard = !geometry.checkerboardPlace.empty() && materials.size() >= 2;
    return isCheckerboard ? geometry.checkerboardPlace : geometry.place;
}

} // namespace

JsonObjects::JsonObjects(JsonProblems& problems, std::size_t expected) : problems_(problems) {
    objects_.reserve(expected);
}

void JsonObjects::addRoot(const std::vector<JsonGeometry>& all, std::size_t root) {
    flatten(all, all[root], {kIdentityRows}, {}, "");
}

std::vector<ObjectDesc> JsonObjects::take() {
    if (failed_) objects_.clear();
    return std::move(objects_);
}

void JsonObjects::flatten(const std::vector<JsonGeometry>& all, const JsonGeometry& geometry,
                          const Keys& worldFromParent, Handles inherited, const std::string& path) {
    if (failed_) return;
    const Handles materials =
        usable(geometry, geometry.materials.empty() ? inherited : Handles(geometry.materials));
    const Keys worldFromThis = product(worldFromParent, placeOf(geometry, materials));
    if (worldFromThis.empty()) return failKeys(geometry, worldFromParent);
    // Nodes count too: following them takes the same time.
    if (!hasRoomFor(worldFromThis, geometry.shape ? materials.size() : 0, geometry.loc)) return;
    const bool fits = path.size() + geometry.name.size() < kLongestPath;
    const std::string name = path.empty() || !fits ? geometry.name : cat(path, '/', geometry.name);
    if (geometry.shape) {
        ObjectDesc& object = objects_.emplace_back(*geometry.shape);
        object.name = names_.of(name);
        object.worldFromObject = worldFromThis;
        object.materials.assign(materials.begin(), materials.end());
        return;
    }
    const JsonGeometry& body =
        geometry.sharesChildrenOf ? all[*geometry.sharesChildrenOf] : geometry;
    for (const std::size_t child : body.children)
        flatten(all, all[child], worldFromThis, materials, name);
}

bool JsonObjects::hasRoomFor(const Keys& keys, std::size_t materials, SourceLoc loc) {
    size_ += keys.size() + materials;
    if (size_ <= kLargest) return true;
    failed_ = true;
    problems_.fatal(loc, [] {
        return cat("with this the keys and materials of all objects are more than ", kLargest,
                   ", counting each copy that nodes and instances make");
    });
    return false;
}

void JsonObjects::failKeys(const JsonGeometry& geometry, const Keys& worldFromParent) {
    failed_ = !problems_.isLenient();
    problems_.error(geometry.loc, [&] {
        return cat("'", shown(geometry.name), "' has ", geometry.place.size(),
                   " keys, and what is above it ", worldFromParent.size(),
                   "; moving things inside each other need the same count");
    });
}
