// The list "objects" of a JSON scene: at once or, in large files, in parts.
#pragma once

#include "read/json/dialect.h"
#include "read/json/materials.h"

#include <optional>
#include <vector>

// What the objects of a scene are read with. What they are to refer to is complete, and of the
// scene's keys theirs is the last one.
struct JsonSurroundings {
    JsonFields& scene;
    const JsonRules& rules;
    const JsonNames& textures;
    const JsonMaterials& materials;
    std::vector<MeshDesc>& meshes;
};

std::vector<ObjectDesc> readJsonObjects(const JsonSurroundings& with);

// From the places that parseJsonOutline() found: the same, but as soon as there is anything to say
// of an object, or one refers to another one, it is nothing.
std::optional<std::vector<ObjectDesc>> readJsonObjectsInParts(const SourceFile& source,
                                                              const JsonArrayScan& list,
                                                              int threads,
                                                              const JsonSurroundings& with);
