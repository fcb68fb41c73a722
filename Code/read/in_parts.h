// A long text is read in parts, a quick way that gives up where there is anything to say; reading
// all of it in order then says it.
#pragma once

#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <cstddef>
#include <optional>

// Nothing, or an Error, when it gives up.
using ReadInParts = std::optional<SceneDesc>(const SourceFile&, const ReadContext&,
                                             std::size_t partBytes);
using ReadInOrder = SceneDesc(const SourceFile&, const ReadContext&);

// In parts if the text is longer than one. What was warned of before they gave up is not heard.
SceneDesc readInPartsOrInOrder(const SourceFile& source, const ReadContext& context,
                               std::size_t partBytes, ReadInParts& readInParts,
                               ReadInOrder& readInOrder);
