// A scene around a file of triangles, for `raytracer bunny.obj`: its parts as objects with the
// materials of its libraries, and a camera and lights that show all of it. +Y is up, as in most of
// these files; the camera looks from the front, a little from the right and from above.
#pragma once

#include "desc/scene_desc.h"
#include "read/mesh/mesh_file.h"
#include "read/mesh/read_mtl.h"
#include "read/read_context.h"

#include <span>

// `libraries`: the materials of file.libraries in their order; one that could not be read is empty.
// Materials that none of them has are grey, with a warning. Textures keep their names; their `file`
// is what the libraries say. Places (loc) are in `source`: a material's is where it is used first.
SceneDesc sceneAround(MeshFile file, std::span<const MtlFile> libraries, const SourceFile& source,
                      const ReadContext& context);
