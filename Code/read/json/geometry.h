// The objects of a JSON scene as a tree: shapes, and nodes and instances with what hangs below
// them. Whatever the file says more than once (an instance of an instance) stands here once.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/dialect.h"
#include "read/json/fields.h"
#include "read/json/materials.h"

#include <cstddef>
#include <optional>
#include <string>
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

struct JsonGeometries {
    std::vector<JsonGeometry> all;
    std::vector<std::size_t> roots; // those of the list "objects"
};

// So many geometries may a scene have when instances are written out, and so deep may they nest.
inline constexpr std::size_t kMostJsonGeometries = std::size_t{1} << 20;
inline constexpr int kDeepestJsonGeometry = 1000;

JsonGeometries readJsonGeometries(JsonFields& scene, const JsonRules& rules,
                                  const JsonNames& textures, const JsonMaterials& materials,
                                  std::vector<MeshDesc>& meshes);
