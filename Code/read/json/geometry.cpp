#include "read/json/geometry.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/json/names.h"
#include "read/json/placement.h"

#include <algorithm>

JsonGeometryReader::JsonGeometryReader(JsonProblems& problems, const JsonRules& rules,
                                       const JsonNames& textures, const JsonMaterials& materials,
                                       std::vector<MeshDesc>& meshes)
    : problems_(problems), rules_(rules), textures_(textures), materials_(materials),
      meshes_(meshes) {
    types_.insert(types_.end(), {"node", "instance"});
}

JsonGeometryReader::Index JsonGeometryReader::addRoot(const JsonValue& value) {
    const Index index = readOne(value, true);
    if (index) count(all_[*index].count, all_[*index].loc);
    return index;
}

void JsonGeometryReader::count(std::size_t geometries, SourceLoc loc) {
    const bool wasSmall = total_ <= kMostJsonGeometries;
    total_ += geometries;
    if (wasSmall && total_ > kMostJsonGeometries)
        problems_.fatal(loc, [] {
            return cat("with this the scene has more than ", kMostJsonGeometries,
                       " objects, counting each copy that nodes and instances make");
        });
}

JsonGeometryReader::Index JsonGeometryReader::readOne(const JsonValue& value, bool isTopLevel) {
    if (!value.isObject()) {
        problems_.error(value.loc(), [&] {
            return cat("expected an object in 'objects', got ", described(value));
        });
        return {};
    }
    const JsonValue* typeValue = value.find("type");
    const JsonValue* nameValue = value.find("name");
    const std::string type(typeValue ? typeValue->text() : "");
    const std::string shownName = nameValue ? shown(nameValue->text()) : "";
    if (!isKnown(typeValue, type, value)) return {};

    // (Put together by hand: cat() is slow, and there may be a million objects.)
    std::string what = "the " + type;
    if (!shownName.empty()) what += " '" + shownName + "'";
    JsonFields fields(value, std::move(what), problems_);
    JsonGeometry geometry;
    readHead(geometry, fields);
    const std::string name = geometry.name;
    if (name.empty()) geometry.name = cat(type, ++unnamed_[type]);
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
        anywhere_.add(name, static_cast<Handle>(index));
        if (isTopLevel && type == "node") topNodes_.add(name, static_cast<Handle>(index));
    }
    all_.push_back(std::move(geometry));
    return index;
}

void JsonGeometryReader::readHead(JsonGeometry& geometry, JsonFields& fields) {
    geometry.loc = fields.loc();
    fields.take("type");
    fields.read("name", geometry.name);
    geometry.materials = materials_.of(fields);
}

bool JsonGeometryReader::isKnown(const JsonValue* typeValue, const std::string& type,
                                 const JsonValue& value) {
    if (std::find(types_.begin(), types_.end(), type) != types_.end()) return true;
    if (!typeValue || typeValue->isNull())
        problems_.error(value.loc(),
                        [&] { return cat("an object needs a 'type': ", join(types_)); });
    else if (!typeValue->isString())
        problems_.error(typeValue->loc(), [&] {
            return cat("expected a text for 'type', got ", described(*typeValue));
        });
    else
        problems_.error(typeValue->loc(), [&] {
            return cat("unknown type of object ", unknownName(shown(type), types_));
        });
    return false;
}

void JsonGeometryReader::readShape(JsonGeometry& geometry, std::string_view type,
                                   JsonFields& fields) {
    auto shape = readJsonShape(type, fields, rules_, textures_, meshes_);
    geometry.place = std::move(shape->place);
    geometry.checkerboardPlace = std::move(shape->checkerboard);
    geometry.shape = std::move(shape->object);
    using Kind = ObjectDesc::Kind;
    const Kind kind = geometry.shape->kind;
    const std::size_t most = kind == Kind::InfinitePlane ? 2 : 1;
    if (geometry.materials.size() >= 2 && kind == Kind::InfinitePlane &&
        geometry.checkerboardPlace == geometry.place)
        problems_.warn(geometry.loc, [&] {
            return cat(fields.what(), " is vertical: squares of x and z would be stripes on it; "
                                      "squares of the plane itself are taken instead");
        });
    if (kind == Kind::Mesh || geometry.materials.size() <= most) return;
    problems_.warn(geometry.loc, [&] {
        return cat(fields.what(), " has ", geometry.materials.size(), " materials; only the ",
                   most == 1 ? "first counts" : "first two count");
    });
    geometry.materials.resize(most);
}

void JsonGeometryReader::readNode(JsonGeometry& node, JsonFields& fields) {
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
        problems_.error(refValue->loc(),
                        [&] { return cat(fields.what(), ": give 'ref' or 'children', not both"); });
    if (!rules_.refReplaces) return readReference(node, ref, *refValue);
    const Index target = find(topNodes_, ref, *refValue, "top-level node");
    if (!target) return;
    const JsonGeometry& original = all_[*target];
    node.sharesChildrenOf = original.sharesChildrenOf.value_or(*target);
    node.count = original.count;
    node.depth = original.depth;
    if (node.materials.empty()) node.materials = original.materials;
}

void JsonGeometryReader::readInstance(JsonGeometry& instance, JsonFields& fields) {
    instance.place = readJsonPlace(fields);
    std::string ref;
    const JsonValue* refValue = fields.read("ref", ref);
    if (ref.empty())
        problems_.error(refValue ? refValue->loc() : fields.loc(),
                        [] { return "an instance needs a 'ref': the name of an object"; });
    else
        readReference(instance, ref, *refValue);
}
void JsonGeometryReader::readReference(JsonGeometry& instance, const std::string& ref,
                                       const JsonValue& refValue) {
    if (const Index target = find(anywhere_, ref, refValue, "object")) addChild(instance, *target);
}

void JsonGeometryReader::addChild(JsonGeometry& parent, std::size_t index) const {
    const JsonGeometry& child = all_[index];
    parent.children.push_back(index);
    // Beyond the limit it need not be exact, but must not overflow.
    parent.count = std::min(parent.count + child.count, kMostJsonGeometries + 1);
    parent.depth = std::max(parent.depth, child.depth + 1);
}
void JsonGeometryReader::checkDepth(const JsonGeometry& geometry) {
    if (geometry.depth == kDeepestJsonGeometry + 1)
        problems_.fatal(geometry.loc, [] {
            return cat("nodes and instances are nested more than ", kDeepestJsonGeometry,
                       " deep here");
        });
}

JsonGeometryReader::Index JsonGeometryReader::find(const JsonNames& names, const std::string& name,
                                                   const JsonValue& ref, std::string_view what) {
    const Handle handle = names.find(name);
    if (handle == kNone) {
        problems_.error(ref.loc(), [&] {
            return cat("no earlier ", what, " is named ", unknownName(shown(name), names.known()));
        });
        return {};
    }
    if (names.uses(name) > 1)
        problems_.warn(ref.loc(), [&] {
            return cat(names.uses(name), " earlier objects are named '", shown(name),
                       "'; the first of them is meant");
        });
    return static_cast<std::size_t>(handle);
}
