// What a scene in JSON has that cannot be rendered, and does without under --lenient.
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

// Takes out what validate() would refuse: lights, objects, meshes that could not be read, and a
// crop. Warns of each. The scene has its meshes.
void leaveOutWrong(SceneDesc& desc, const SourceFile& source, const ReadContext& context);

// A message as a warning, with what follows from it.
std::string asWarning(std::string message, std::string_view consequence);
