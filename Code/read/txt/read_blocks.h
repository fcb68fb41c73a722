// The blocks of a native scene file, or of a part of one, in the order of the text.
#pragma once

#include "base/source.h"
#include "desc/error_list.h"
#include "desc/scene_desc.h"
#include "read/txt/references.h"

#include <cstddef>
#include <string_view>
#include <vector>

// Blocks begin in [first, last) of the text; none reaches over its `first`.
struct TxtPart {
    std::size_t first = 0, last = 0;
    int threads = 1; // for the arrays of large meshes
};
// Parts of about `partBytes` that begin behind lines with a '}', which end blocks in every file
// without a mistake. The first one begins at `first`; they do not depend on how many threads there
// are, only whose meshes get `threads` does: one that is a large part of the file.
std::vector<TxtPart> partsOf(std::string_view text, std::size_t first, std::size_t partBytes,
                             int threads);

struct Blocks {
    SceneDesc desc;
    References references; // to be resolved when the whole file is known
};

// The first mistake of form ends the reading with an Error; wrong values are collected. Returns
// where it ended: behind `last` when the last block goes on there.
std::size_t readBlocks(const SourceFile& source, const TxtPart& part, ErrorList& errors,
                       Blocks& blocks);
