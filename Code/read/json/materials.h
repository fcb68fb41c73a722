// Textures and materials of a JSON scene, and how objects refer to materials: by number (ID) or by
// name.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/fields.h"
#include "read/json/names.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

JsonNames readJsonTextures(JsonFields& scene, std::vector<TextureDesc>& textures);

class JsonMaterials {
public:
    JsonMaterials(JsonFields& scene, const JsonNames& textures, std::vector<MaterialDesc>& out);

    // The materials that an object names, in its order. Unknown ones are left out with a warning.
    std::vector<Handle> of(JsonFields& object) const;

private:
    void addId(const JsonValue& value, Handle handle, JsonProblems& problems);
    Handle find(const JsonValue& value, JsonProblems& problems) const;

    JsonNames names_;
    std::unordered_map<std::int64_t, Handle> ids_;
};
