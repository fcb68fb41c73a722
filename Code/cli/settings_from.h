// RenderSettings from the scene file and the command line; what the command line says comes first.
#pragma once

#include "cli/options.h"
#include "desc/scene_desc.h"
#include "render/settings.h"

// Fails with ErrorKind::Usage when the choices do not fit the scene (unknown camera, crop outside
// the picture).
RenderSettings settingsFrom(const SceneDesc& desc, const Options& options);

// The scene with all that the options say about it, for --convert.
SceneDesc withSettings(SceneDesc desc, const RenderSettings& settings);
