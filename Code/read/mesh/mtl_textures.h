// The map statements of MTL: options, then the name of a picture file.
#pragma once

#include "desc/scene_desc.h"
#include "read/mesh/line_reader.h"
#include "read/unique_names.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

// Textures with different names; equal ones (file, options, use) are one.
class MtlTextures {
public:
    struct Map {
        Handle texture = kNone;
        std::optional<double> bumpStrength; // -bm
    };
    // From behind the keyword to the end of the line.
    Map read(LineReader& in, std::string_view keyword, TextureDesc::Space space);

    std::vector<TextureDesc> textures;

private:
    Handle add(TextureDesc texture);

    std::unordered_map<std::string, Handle> known_; // by all that a texture says
    UniqueNames names_;
};
