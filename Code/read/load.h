// From a file name to a scene that is known to be sound: the one way in for main().
#pragma once

#include "base/error.h"
#include "base/source.h"
#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <string>

struct LoadedScene {
    SourceFile source; // for messages about places in desc
    SceneDesc desc;
};

// The reader is chosen by the extension; "-" is native text on stdin. The meshes that the scene
// keeps in files are read as well. Throws Error (Input).
LoadedScene load(const std::string& fileName, Diagnostics& diagnostics,
                 const ReadOptions& options = {});
