// The map statements of MTL: options, then the name of a picture file.
#pragma once

#include "desc/scene_desc.h"
#include "read/mesh/line_reader.h"
#include "read/read_context.h"
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

// Wavefront MTL, the materials of OBJ files.
//   Kd, map_Kd    diffuse, and its texture. Without Kd a texture shows unchanged
//   Ks, map_Ks    specular = Ks/pi with exponent Ns (Blinn): the classic picture, where Kd and Ks
//   are
//                 both factors of the light, has its balance kept by our diffuse = Kd/pi
//   illum 0, 1    no highlight
//   illum 3, 8    mirror = Ks; 5: mirror = Ks with Schlick's Fresnel, growing to 1 at grazing
//   angles illum 4 6 7 9 glass of index Ni: transmission = Tf (or white) and mirror = white, shared
//   by the
//                 Fresnel equations; a dissolve d < 1 leaves the part d of the surface diffuse.
//                 With map_d it is no glass but a cut-out
//   d, Tr = 1 - d opacity (d wins), else; Tf tints what shines through; map_d its texture
//   Ke, map_Ke    emission
//   map_bump      bump map (-bm: its strength); norm: normal map
//   Pr            roughness of mirror and glass
// Ambient terms are left out: what lights the scene is the renderer's.

struct MtlFile {
    std::vector<MaterialDesc> materials; // texture handles count in `textures`
    std::vector<TextureDesc> textures;   // `file` as the text has it, relative to the MTL file
};
// Fails with the place of a wrong line. A name given twice means its first material.
MtlFile readMtl(const SourceFile& source, const ReadContext& context);
