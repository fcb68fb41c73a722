// The native scene format, see ASCII/README.md. A pure function: no options, no other files.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"

#include <cstddef>

// Throws Error: the first mistake of form ends the reading; wrong values and unknown names are
// collected up to there. What several blocks mean together is validate()'s business. What is read
// and said depends neither on the number of threads (0: as many as the machine has), which large
// files use, nor on how many bytes of text one thread reads at a time (0: as is best).
SceneDesc readTxt(const SourceFile& source, int threads = 1, std::size_t partBytes = 0);
