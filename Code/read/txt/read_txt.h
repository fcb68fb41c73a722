// The native scene format, see ASCII/README.md. A pure function: no options, no other files.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"

// Throws Error: the first mistake of form ends the reading; wrong values and unknown names are
// collected up to there. What several blocks mean together is validate()'s business.
SceneDesc readTxt(const SourceFile& source);
