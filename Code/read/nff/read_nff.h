// NFF, the Neutral File Format of the Standard Procedural Databases (Haines 1987).
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

SceneDesc readNff(const SourceFile& source, const ReadContext& context);
