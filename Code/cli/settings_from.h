// RenderSettings from the scene file and the command line; what the command line says comes first.
#pragma once

#include "cli/options.h"
#include "desc/scene_desc.h"
#include "isa/isa.h"
#include "scene/settings.h"

#include <string>
#include <string_view>
#include <vector>

// Fails with ErrorKind::Usage when the choices do not fit the scene (unknown camera, crop outside
// the picture).
RenderSettings settingsFrom(const SceneDesc& desc, const Options& options);

// The scene with all that the options say about it, for --convert.
SceneDesc withSettings(SceneDesc desc, const RenderSettings& settings);

// The instruction set that --kernel names.

// The names of all, the best first.
std::vector<std::string> kernelNames();
// By name; "auto" is the best that the CPU has. Fails for a name that there is not or that this CPU
// can't run, and says which it can.
const Isa& chooseKernel(std::string_view name);
