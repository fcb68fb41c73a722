// A scene around a file of triangles, for `raytracer bunny.obj`: its parts as objects with the
// materials of its libraries, and a camera and lights that show all of it.
#pragma once

#include "desc/scene_desc.h"
#include "read/mesh_file.h"
#include "read/read_context.h"
#include "read/read_mtl.h"

#include <span>

// `libraries`: the materials of file.libraries in their order. Materials that none of them has are
// grey, with a warning. Textures keep their names; their `file` is what the libraries say.
SceneDesc sceneAround(MeshFile file, std::span<const MtlFile> libraries, const SourceFile& source,
                      const ReadContext& context);
