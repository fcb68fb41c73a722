#include "read/json/objects.h"
#include "read/unique_names.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/json/names.h"
#include "read/json/placement.h"

#include <algorithm>
#include <span>

namespace {

class Flattener {
public:
    Flattener(const JsonGeometries& geometries, JsonProblems& problems)
        : geometries_(geometries), problems_(problems) {}

    std::vector<ObjectDesc> run() {
        objects_.reserve(geometries_.roots.size());
        for (const std::size_t root : geometries_.roots)
            flatten(geometries_.all[root], {kIdentityRows}, {}, "");
        return std::move(objects_);
    }

private:
    using Handles = std::span<const Handle>;

    void flatten(const JsonGeometry& geometry, const Keys& worldFromParent, Handles inherited,
                 const std::string& path) {
        if (failed_) return;
        const Handles materials =
            usable(geometry, geometry.materials.empty() ? inherited : Handles(geometry.materials));
        const bool isCheckerboard = !geometry.checkerboardPlace.empty() && materials.size() >= 2;
        const Keys worldFromThis =
            product(worldFromParent, isCheckerboard ? geometry.checkerboardPlace : geometry.place);
        if (worldFromThis.empty()) return failKeys(geometry, worldFromParent);
        // Nodes count too: following them takes the same time.
        size_ += worldFromThis.size() + (geometry.shape ? materials.size() : 0);
        if (size_ > kLargest) return failSize(geometry);
        const bool fits = path.size() + geometry.name.size() < kLongestPath;
        const std::string name =
            path.empty() || !fits ? geometry.name : cat(path, '/', geometry.name);
        if (geometry.shape) return add(geometry, worldFromThis, materials, name);
        const JsonGeometry& body =
            geometry.sharesChildrenOf ? geometries_.all[*geometry.sharesChildrenOf] : geometry;
        for (const std::size_t child : body.children)
            flatten(geometries_.all[child], worldFromThis, materials, name);
    }

    // What is handed down may be more than a shape can show.
    static Handles usable(const JsonGeometry& geometry, Handles materials) {
        if (!geometry.shape || geometry.shape->kind == ObjectDesc::Kind::Mesh) return materials;
        const std::size_t most = geometry.shape->kind == ObjectDesc::Kind::InfinitePlane ? 2 : 1;
        return materials.first(std::min(most, materials.size()));
    }

    void add(const JsonGeometry& geometry, const Keys& worldFromObject, Handles materials,
             const std::string& name) {
        ObjectDesc& object = objects_.emplace_back(*geometry.shape);
        object.name = names_.of(name);
        object.worldFromObject = worldFromObject;
        object.materials.assign(materials.begin(), materials.end());
    }

    void failSize(const JsonGeometry& geometry) {
        failed_ = true;
        problems_.error(geometry.loc, [] {
            return cat("with this the keys and materials of all objects are more than ", kLargest,
                       ", counting each copy that nodes and instances make");
        });
    }

    void failKeys(const JsonGeometry& geometry, const Keys& worldFromParent) {
        failed_ = true;
        problems_.error(geometry.loc, [&] {
            return cat("'", shown(geometry.name), "' has ", geometry.place.size(),
                       " keys, and what is above it ", worldFromParent.size(),
                       "; moving things inside each other need the same count");
        });
    }

    static constexpr std::size_t kLongestPath = 200;
    static constexpr std::size_t kLargest = std::size_t{1} << 22;

    const JsonGeometries& geometries_;
    JsonProblems& problems_;
    std::vector<ObjectDesc> objects_;
    UniqueNames names_;
    std::size_t size_ = 0; // of all keys and material lists
    bool failed_ = false;
};

} // namespace

std::vector<ObjectDesc> flattenJson(const JsonGeometries& geometries, JsonProblems& problems) {
    return Flattener(geometries, problems).run();
}
