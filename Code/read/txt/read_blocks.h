// The blocks of a native scene file, or of a part of one, in the order of the text.
#pragma once

#include "base/source.h"
#include "desc/error_list.h"
#include "desc/scene_desc.h"
#include "read/txt/references.h"

#include <cstddef>

// Blocks begin in [first, last) of the text; none reaches over its `first`.
struct TxtPart {
    std::size_t first = 0, last = 0;
    int threads = 1; // for the arrays of large meshes
};

struct Blocks {
    SceneDesc desc;
    References references; // to be resolved when the whole file is known
};

// The first mistake of form ends the reading with an Error; wrong values are collected. Returns
// where it ended: behind `last` when the last block goes on there.
std::size_t readBlocks(const SourceFile& source, const TxtPart& part, ErrorList& errors,
                       Blocks& blocks);
