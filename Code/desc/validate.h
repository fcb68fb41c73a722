// The rules of a scene that do not depend on the format it came from.
#pragma once

#include "base/error.h"
#include "base/source.h"
#include "desc/scene_desc.h"

#include <string>

// Throws one Error with all mistakes (the first 20, with their places). What only looks wrong, as a
// scene without light, becomes a warning. After it, every handle and index is in range, every
// number that has an effect is finite and in its range (desc/properties.h), every transform can be
// inverted. Meshes that still name a file
// (read/mesh_files.h) are not looked into.
// The same for any number of threads.
void validate(const SceneDesc& desc, const SourceFile& source, Diagnostics& diagnostics,
              int threads = 1);

// What is wrong with the part of the picture that is wanted; empty when nothing is.
std::string faultOfCrop(const SettingsDesc& settings);

// Whether a light shines by a surface, and has none. Such a light is left out, with a warning.
bool hasNoArea(const LightDesc& light);
