// Lines of a text in chunks that threads can read at the same time: lines are counted much faster
// than numbers are read.
#pragma once

#include <cstddef>
#include <vector>

struct LineChunk {
    const char* first = nullptr;       // the start of a line
    std::size_t before = 0, lines = 0; // of the array: those in front, those in here
};
// The next `count` lines of the text; fewer when there are not so many.
std::vector<LineChunk> chunksOfLines(const char* text, const char* end, std::size_t count,
                                     int threads);
