// How long a text may be.
#pragma once

#include "base/source.h"
#include "base/text.h"
#include "desc/scene_desc.h"

// Locations are 32 bits wide.
inline void checkTextSize(const SourceFile& source) {
    if (source.text.size() >= SourceLoc::kUnknown)
        fail(ErrorKind::Input, cat(source.name, ": error: the file is larger than 4 GiB"));
}
