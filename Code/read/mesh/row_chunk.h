// Some rows of an element of a PLY file, where they are taken to be.
#pragma once

#include <cstddef>

struct RowChunk {
    const char* first = nullptr;
    std::size_t firstRow = 0, count = 0;
};
