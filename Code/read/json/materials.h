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

// The lobes of a material: a list "lobes" of objects with a "type", "weight", the fields of that
// type, and "covers". A value is a number, an array of three, or an object with that as "value" and
// a list "factors" of {"times": TEXTURE} and {"without": TEXTURE, "strength": S}. Takes the key
// "lobes"; where there is one, nothing is diffuse unless it is said.
void readJsonLobes(JsonFields& fields, const JsonNames& textures, MaterialDesc& material);

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
