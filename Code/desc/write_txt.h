// SceneDesc -> native text (ASCII/README.md); reading it back gives an equal SceneDesc.
#pragma once

#include "desc/scene_desc.h"

#include <string>

// For scenes that validate() accepts. Numbers are the shortest that read back to the same bits;
// what has its default value is left out, and so is what its kind of object does not have.
std::string writeTxt(const SceneDesc& desc);
