// The objects of a JSON scene as a tree: shapes, and nodes and instances with what hangs below
// them. Whatever the file says more than once (an instance of an instance) stands here once.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/json.h"
#include "read/json/fields.h"
#include "read/json/materials.h"
#include "read/json/shapes.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

struct JsonGeometry {
    std::string name; // as the file has it, or by type and number
    SourceLoc loc;
    Keys place{kIdentityRows};     // parent from this
    Keys checkerboardPlace;        // of a plane that has, or is handed down, two materials
    std::vector<Handle> materials; // none: those of the node above
    // A shape (without name, place and materials), or a node, which has none.
    std::optional<ObjectDesc> shape;
    // What a node shows: the geometries below it. They come before it in the list.
    std::vector<std::size_t> children;
    // Another node whose children these are too: they are not copied.
    std::optional<std::size_t> sharesChildrenOf;
    // How many geometries a copy of this makes, itself included, and how deep they are nested.
    std::size_t count = 1;
    int depth = 1;
};

// So many geometries may a scene have when instances are written out, and so deep may they nest.
inline constexpr std::size_t kMostJsonGeometries = std::size_t{1} << 20;
inline constexpr int kDeepestJsonGeometry = 1000;

class JsonGeometryReader {
public:
    JsonGeometryReader(JsonProblems& problems, const JsonRules& rules, const JsonNames& textures,
                       const JsonMaterials& materials, std::vector<MeshDesc>& meshes);

    const std::vector<JsonGeometry>& all() const { return all_; }
    void reserve(std::size_t geometries) { all_.reserve(geometries); }
    // An item of the list "objects", by its place in all(). Nothing when it is skipped or wrong.
    std::optional<std::size_t> addRoot(const JsonValue& value);

private:
    using Index = std::optional<std::size_t>;

    Index readOne(const JsonValue& value, bool isTopLevel);
    bool isKnown(const JsonValue* typeValue, const std::string& type, const JsonValue& value);
    void readHead(JsonGeometry& geometry, JsonFields& fields);
    void readShape(JsonGeometry& geometry, std::string_view type, JsonFields& fields);
    void readNode(JsonGeometry& node, JsonFields& fields);
    void readInstance(JsonGeometry& instance, JsonFields& fields);
    void readReference(JsonGeometry& instance, const std::string& ref, const JsonValue& refValue);
    void addChild(JsonGeometry& parent, std::size_t index) const;
    void checkDepth(const JsonGeometry& geometry);
    void count(std::size_t geometries, SourceLoc loc);
    Index find(const JsonNames& names, const std::string& name, const JsonValue& ref,
               std::string_view what);

    JsonProblems& problems_;
    const JsonRules& rules_;
    const JsonNames& textures_;
    const JsonMaterials& materials_;
    JsonMeshes meshes_;
    std::vector<std::string> types_ = jsonShapeWords(); // and those that are no shapes
    std::size_t total_ = 0;
    std::vector<JsonGeometry> all_;
    JsonNames anywhere_, topNodes_;
    std::unordered_map<std::string, int> unnamed_; // by type
};
