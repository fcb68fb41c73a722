// From a file name to a scene that is known to be sound: the one way in for main().
#pragma once

#include "base/error.h"
#include "base/function_ref.h"
#include "base/source.h"
#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <string>

struct LoadedScene {
    SourceFile source; // for messages about places in desc
    SceneDesc desc;
    // Pictures that cannot be read are left out with a warning, and are no error: those of meshes,
    // which often come without them, and of JSON under --lenient.
    bool picturesMayMiss = false;
};

// The reader is chosen by the extension; "-" is native text on stdin. The meshes that the scene
// keeps in files are read as well. Throws Error (Input).
// foreseen(desc, name of the scene's file): what is known of it so far and may still be wrong, for
// who can begin something with that. Called once or more often, and does not throw.
using Foreseen = FunctionRef<void(const SceneDesc& desc, const std::string& sceneFile)>;
LoadedScene load(const std::string& fileName, Diagnostics& diagnostics,
                 const ReadOptions& options = {}, Foreseen foreseen = {});
