// The files that a scene names for its meshes, and mesh files that are to be seen by themselves.
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <string>
#include <vector>

// Extensions of the files below, lower case, with their dots.
std::vector<std::string> meshFileExtensions();

// Reads every mesh that names a file and empties the name: relative to the scene's folder, then to
// the working directory, then to the folder around the scene's. Material slots are in the order in
// which the file uses its materials. Fails at the place of the name.
void loadMeshFiles(SceneDesc& desc, const SourceFile& scene, const ReadContext& context);

// A scene around a mesh file, with the materials of the libraries beside it.
SceneDesc readMeshScene(const SourceFile& source, const ReadContext& context);
