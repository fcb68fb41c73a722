// Scenes of the course COMP 557 in JSON, all four dialects, and the keys that this renderer adds
// (ASCII/JSON.md). Everything that the format means differently is settled here.
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <cstddef>

SceneDesc readJson(const SourceFile& source, const ReadContext& context);
// Texts of more than partBytes are read in parts of about so much. Nothing that is read and no
// message depends on it.
SceneDesc readJson(const SourceFile& source, const ReadContext& context, std::size_t partBytes);
