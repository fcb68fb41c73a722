// The shapes of a JSON scene, each as an ObjectDesc and a place.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/json.h"
#include "read/json/fields.h"
#include "read/json/names.h"
#include "read/unique_names.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Meshes by file: objects that name the same one share it.
class JsonMeshes {
public:
    explicit JsonMeshes(std::vector<MeshDesc>& meshes) : meshes_(meshes) {}
    // Takes 'filepath' and 'smooth_angle'.
    Handle read(JsonFields& fields);

private:
    std::vector<MeshDesc>& meshes_;
    std::map<std::pair<std::string, double>, Handle> known_;
    UniqueNames names_;
};

struct JsonShape {
    ObjectDesc object; // without name, place and materials
    Keys place;        // parent from object
    Keys checkerboard; // the same for a plane of two materials; empty for all others
};

// "sphere", "box", ...
std::vector<std::string> jsonShapeWords();
// Takes everything that a shape of this type has, but for its name and materials. Nothing when
// there is no such type.
std::optional<JsonShape> readJsonShape(std::string_view type, JsonFields& fields,
                                       const JsonRules& rules, const JsonNames& textures,
                                       JsonMeshes& meshes);
