// Finds and reads the picture that a texture of a scene names.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"
#include "image/image.h"

#include <optional>
#include <string>
#include <vector>

// The textures that materials, and the world if it shows its environment, use: in the order of
// their first use. Handles that are no texture's are left out.
std::vector<std::size_t> usedTextures(const SceneDesc& desc, bool showsEnvironment);

// Where the picture is that a texture of the scene in `sceneFile` names: see loadPicture().
std::optional<std::string> findPicture(const std::string& file, const std::string& sceneFile,
                                       const std::string& textureFolder);

// Searched beside the scene file, in `textureFolder` (if not empty) and in Textures/, each with the
// path as written and then by the file's name alone. Fails at the texture's line in the scene file
// with the places that were tried, or with what is wrong with the picture.
StoredImage loadPicture(const TextureDesc& texture, const SourceFile& source,
                        const std::string& textureFolder);
// The same; nothing when it fails, with what is wrong in `fault`.
std::optional<StoredImage> findAndRead(const TextureDesc& texture, const std::string& sceneFile,
                                       const std::string& textureFolder, std::string& fault);
