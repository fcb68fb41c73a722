// Scenes of the course COMP 557 in JSON, all four dialects, and the keys that this renderer adds
// (ASCII/JSON.md). Everything that the format means differently is settled here.
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

SceneDesc readJson(const SourceFile& source, const ReadContext& context);
