// A native scene file in parts that threads can read at the same time.
#pragma once

#include "read/txt/read_blocks.h"

#include <string_view>
#include <vector>

// Parts of about `partBytes` that begin behind lines with a '}', which end blocks in every file
// without a mistake. The first one begins at `first`; they do not depend on how many threads there
// are, only whose meshes get `threads` does: one that is a large part of the file.
std::vector<TxtPart> partsOf(std::string_view text, std::size_t first, std::size_t partBytes,
                             int threads);
