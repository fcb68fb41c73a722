// What a reader may know besides the text: the choices that the command line offers, and where its
// warnings go. Readers open no files of their own; load.cpp brings what they name.
#pragma once

#include "base/error.h"
#include "base/source.h"
#include "base/text.h"
#include "desc/scene_desc.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

struct ReadOptions {
    // JSON: what is wrong or not known is left out with a warning instead of being an error.
    bool lenient = false;
    // NFF: `angle` reaches from edge to edge of the picture, as POV-Ray reads it, and not from the
    // centre of the first to the centre of the last pixel row, as the standard says.
    bool nffAngleToEdges = false;
    // For files that are read at the same time, and large ones; 0: as many as the machine has.
    // Nothing that is read and no message depends on it.
    int threads = 1;
};

struct ReadContext {
    ReadOptions options;
    Diagnostics& diagnostics;

    void warn(const SourceFile& source, std::size_t offset, std::string_view what) const {
        diagnostics.warnings.push_back(located(source, offset, what, "warning"));
    }
};

// How often something happened, and where first.
struct Counted {
    std::size_t count = 0, first = 0;
    void add(const Counted& other) {
        if (other.count == 0) return;
        first = count == 0 ? other.first : std::min(first, other.first);
        count += other.count;
    }
    void add(std::size_t offset) { add(Counted{1, offset}); }
};

// Locations are 32 bits wide.
inline void checkTextSize(const SourceFile& source) {
    if (source.text.size() >= SourceLoc::kUnknown)
        fail(ErrorKind::Input, cat(source.name, ": error: the file is larger than 4 GiB"));
}
