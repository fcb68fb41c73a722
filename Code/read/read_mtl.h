// Wavefront MTL, the materials of OBJ files.
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <vector>

struct MtlFile {
    std::vector<MaterialDesc> materials; // texture handles count in `textures`
    std::vector<TextureDesc> textures;   // `file` as the text has it, relative to the MTL file
};
MtlFile readMtl(const SourceFile& source, const ReadContext& context);
