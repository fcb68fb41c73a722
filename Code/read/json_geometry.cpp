#include "read/json_geometry.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/json_names.h"
#include "read/json_placement.h"
#include "read/json_shapes.h"

#include <algorithm>
#include <unordered_map>

namespace {

class GeometryReader {
public:
    GeometryReader(JsonFields& scene, const JsonRules& rules, const JsonNames& textures,
                   const JsonMaterials& materials, std::vector<MeshDesc>& meshes)
        : problems_(scene.problems()), rules_(rules), textures_(textures), materials_(materials),
          meshes_(meshes) {}

    JsonGeometries read(std::span<const JsonValue> objects) {
        std::size_t total = 0;
        for (const JsonValue& value : objects) {
            const auto index = readOne(value, true);
            if (!index) continue;
            roots_.push_back(*index);
            const JsonGeometry& root = all_[*index];
            const bool wasSmall = total <= kMostJsonGeometries;
            total += root.count;
            if (wasSmall && total > kMostJsonGeometries)
                problems_.error(root.loc, [] {
                    return cat("with this the scene has more than ", kMostJsonGeometries,
                               " objects, counting each copy that nodes and instances make");
                });
        }
        return {std::move(all_), std::move(roots_)};
    }

private:
    using Index = std::optional<std::size_t>;

    // Nothing when it is skipped or wrong.
    Index readOne(const JsonValue& value, bool isTopLevel) {
        JsonFields untyped(value, "an object of the scene", problems_);
        if (!value.isObject()) return {};
        std::string type, name;
        const JsonValue* typeValue = untyped.read("type", type);
        untyped.read("name", name);
        if (!isKnown(typeValue, type, value)) return {};

        JsonFields fields(
            value, name.empty() ? cat("the ", type) : cat("the ", type, " '", shown(name), "'"),
            problems_);
        fields.take("type"), fields.take("name");
        JsonGeometry geometry;
        geometry.loc = value.loc();
        geometry.name = name.empty() ? cat(type, ++unnamed_[type]) : name;
        geometry.materials = materials_.of(fields);
        if (type == "node")
            readNode(geometry, fields);
        else if (type == "instance")
            readInstance(geometry, fields);
        else
            readShape(geometry, type, fields);
        fields.reportUnknown();
        checkDepth(geometry);
        const std::size_t index = all_.size();
        // Only from here on it can be referred to: nothing can contain itself.
        if (!name.empty()) {
            remember(anywhere_, name, index);
            if (isTopLevel && type == "node") remember(topNodes_, name, index);
        }
        all_.push_back(std::move(geometry));
        return index;
    }

    bool isKnown(const JsonValue* typeValue, const std::string& type, const JsonValue& value) {
        std::vector<std::string> known = jsonShapeWords();
        known.insert(known.end(), {"node", "instance"});
        if (!typeValue)
            problems_.error(value.loc(),
                            [&] { return cat("an object needs a 'type': ", join(known)); });
        else if (std::find(known.begin(), known.end(), type) != known.end())
            return true;
        else if (typeValue->isString())
            problems_.unknown(typeValue->loc(), [&] {
                return cat("unknown type of object ", unknownName(shown(type), known));
            });
        return false;
    }

    void readShape(JsonGeometry& geometry, const std::string& type, JsonFields& fields) {
        auto shape = readJsonShape(type, fields, rules_, textures_, meshes_);
        geometry.place = std::move(shape->place);
        geometry.checkerboardPlace = std::move(shape->checkerboard);
        geometry.shape = std::move(shape->object);
        const Kind kind = geometry.shape->kind;
        const std::size_t most = kind == Kind::InfinitePlane ? 2 : 1;
        if (geometry.materials.size() >= 2 && kind == Kind::InfinitePlane &&
            geometry.checkerboardPlace == geometry.place)
            problems_.warn(geometry.loc, [&] {
                return cat(fields.what(),
                           " is vertical: squares of x and z would be stripes on it; "
                           "squares of the plane itself are taken instead");
            });
        if (kind == Kind::Mesh || geometry.materials.size() <= most) return;
        problems_.warn(geometry.loc, [&] {
            return cat(fields.what(), " has ", geometry.materials.size(), " materials; only the ",
                       most == 1 ? "first counts" : "first two count");
        });
        geometry.materials.resize(most);
    }

    void readNode(JsonGeometry& node, JsonFields& fields) {
        node.place = readJsonPlace(fields);
        std::string ref;
        const JsonValue* refValue = fields.read("ref", ref);
        const auto children = fields.list("children");
        if (ref.empty()) {
            for (const JsonValue& child : children)
                if (const Index index = readOne(child, false)) addChild(node, *index);
            return;
        }
        if (!children.empty())
            problems_.error(refValue->loc(), [&] {
                return cat(fields.what(), ": give 'ref' or 'children', not both");
            });
        if (!rules_.refReplaces) return readReference(node, ref, *refValue);
        const Index target = find(topNodes_, ref, *refValue, "top-level node");
        if (!target) return;
        const JsonGeometry& original = all_[*target];
        node.sharesChildrenOf = original.sharesChildrenOf.value_or(*target);
        node.count = original.count;
        node.depth = original.depth;
        if (node.materials.empty()) node.materials = original.materials;
    }

    void readInstance(JsonGeometry& instance, JsonFields& fields) {
        instance.place = readJsonPlace(fields);
        std::string ref;
        const JsonValue* refValue = fields.read("ref", ref);
        if (ref.empty())
            problems_.error(refValue ? refValue->loc() : fields.loc(),
                            [] { return "an instance needs a 'ref': the name of an object"; });
        else
            readReference(instance, ref, *refValue);
    }
    void readReference(JsonGeometry& instance, const std::string& ref, const JsonValue& refValue) {
        if (const Index target = find(anywhere_, ref, refValue, "object"))
            addChild(instance, *target);
    }

    void addChild(JsonGeometry& parent, std::size_t index) const {
        const JsonGeometry& child = all_[index];
        parent.children.push_back(index);
        // Beyond the limit it need not be exact, but must not overflow.
        parent.count = std::min(parent.count + child.count, kMostJsonGeometries + 1);
        parent.depth = std::max(parent.depth, child.depth + 1);
    }
    void checkDepth(const JsonGeometry& geometry) {
        if (geometry.depth == kDeepestJsonGeometry + 1)
            problems_.error(geometry.loc, [] {
                return cat("nodes and instances are nested more than ", kDeepestJsonGeometry,
                           " deep here");
            });
    }

    struct Table {
        JsonNames names;
        std::unordered_map<std::string, std::size_t> uses;
    };
    static void remember(Table& table, const std::string& name, std::size_t index) {
        table.names.add(name, static_cast<Handle>(index));
        ++table.uses[name];
    }
    Index find(const Table& table, const std::string& name, const JsonValue& ref,
               std::string_view what) {
        const Handle handle = table.names.find(name);
        if (handle == kNone) {
            problems_.error(ref.loc(), [&] {
                return cat("no earlier ", what, " is named ",
                           unknownName(shown(name), table.names.known()));
            });
            return {};
        }
        if (table.uses.at(name) > 1)
            problems_.warn(ref.loc(), [&] {
                return cat(table.uses.at(name), " earlier objects are named '", shown(name),
                           "'; the first of them is meant");
            });
        return static_cast<std::size_t>(handle);
    }

    using Kind = ObjectDesc::Kind;
    JsonProblems& problems_;
    const JsonRules& rules_;
    const JsonNames& textures_;
    const JsonMaterials& materials_;
    JsonMeshes meshes_;
    std::vector<JsonGeometry> all_;
    std::vector<std::size_t> roots_;
    Table anywhere_, topNodes_;
    std::unordered_map<std::string, int> unnamed_; // by type
};

} // namespace

JsonGeometries readJsonGeometries(JsonFields& scene, const JsonRules& rules,
                                  const JsonNames& textures, const JsonMaterials& materials,
                                  std::vector<MeshDesc>& meshes) {
    return GeometryReader(scene, rules, textures, materials, meshes).read(scene.list("objects"));
}
