// Finds and reads the picture that a texture of a scene names.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"
#include "image/image.h"

#include <string>

// Searched beside the scene file, in `textureFolder` (if not empty) and in Textures/, each with the
// path as written and then by the file's name alone. Fails at the texture's line in the scene file
// with the places that were tried, or with what is wrong with the picture.
StoredImage loadPicture(const TextureDesc& texture, const SourceFile& source,
                        const std::string& textureFolder);
