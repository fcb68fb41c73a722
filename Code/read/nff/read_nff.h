// NFF, the Neutral File Format of the Standard Procedural Databases (Haines 1987).
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <cstddef>

SceneDesc readNff(const SourceFile& source, const ReadContext& context);
// Several threads read longer texts in parts of about so much. Nothing that is read and no message
// depends on it.
SceneDesc readNff(const SourceFile& source, const ReadContext& context, std::size_t partBytes);
