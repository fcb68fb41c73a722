// The lobes of a material's description, those that its short keywords mean among them.
#pragma once

#include "desc/scene_desc.h"
#include "render/path/lobed_materials.h"
#include "render/settings.h"

#include <functional>
#include <vector>

struct LobeList {
    std::vector<LobeRow> lobes;
    std::vector<LobeFactor> factors;

    // Whether a picture is to multiply the ior of a lobe that asks for both sides of its surface,
    // which is one number for all that is within.
    bool variesBoundaries() const;
};
// A lobe of this kind whose fields are as if they were left out.
LobeRow lobeRow(std::string_view kind, Rgb weight);
// Sets a number or colour of a lobe. Returns false where the lobe has no field of this name.
bool setField(LobeRow& lobe, std::string_view name, Rgb value);

// Texture of a handle; null: none, or its picture misses.
using TextureOf = std::function<const Texture*(Handle)>;
// All lobes of a material: those that are written as such, and those that the short keywords mean.
// A rough mirror shows lamps by itself, so that it takes the place of a specular highlight.
LobeList lobesOf(const MaterialDesc& desc, const TextureOf& textureOf, const Switches& on);
