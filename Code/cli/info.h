// What a scene contains, for --info and --check.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"
#include "render/scene.h"
#include "render/settings.h"

#include <string>

// Several lines: picture, cameras, counts per kind, triangles, bounds, lights with units, textures
// with sizes, features, memory. Fails when a texture cannot be read.
std::string infoText(const SourceFile& source, const SceneDesc& desc,
                     const RenderSettings& settings, const Scene& scene);

// "12 objects, 3 lights, 4 materials, 34567 triangles": the same in one line.
std::string summaryText(const SceneDesc& desc);
