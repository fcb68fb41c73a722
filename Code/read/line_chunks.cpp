#include "read/line_chunks.h"

#include "base/for_each.h"

#include <algorithm>
#include <cstring>

namespace {

const char* lineStartFrom(const char* p, const char* end) {
    const void* const newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
    return newline ? static_cast<const char*>(newline) + 1 : end;
}

std::size_t linesIn(const char* p, const char* end) {
    std::size_t count = 0;
    for (; p < end; p = lineStartFrom(p, end)) ++count;
    return count;
}

} // namespace

std::vector<LineChunk> chunksOfLines(const char* text, const char* end, std::size_t count,
                                     int threads) {
    constexpr std::size_t kChunkBytes = std::size_t{1} << 16;
    // So many at a time: an array that is short for the file has few.
    const std::size_t atOnce = 8 * static_cast<std::size_t>(threads);
    std::vector<LineChunk> chunks;
    for (std::size_t found = 0; found < count && text < end;) {
        const std::size_t firstNew = chunks.size();
        std::vector<const char*> starts{text};
        while (starts.size() <= atOnce && starts.back() < end) {
            const char* const last = starts.back();
            const bool isRest = static_cast<std::size_t>(end - last) <= kChunkBytes;
            starts.push_back(isRest ? end : lineStartFrom(last + kChunkBytes, end));
            chunks.push_back({last, 0, 0});
        }
        text = starts.back();
        forEachOn(threads, starts.size() - 1, [&](std::size_t i) {
            chunks[firstNew + i].lines = linesIn(starts[i], starts[i + 1]);
        });
        for (std::size_t i = firstNew; i < chunks.size(); ++i) {
            chunks[i].before = found;
            chunks[i].lines = std::min(chunks[i].lines, count - found);
            found += chunks[i].lines;
        }
    }
    std::erase_if(chunks, [](const LineChunk& chunk) { return chunk.lines == 0; });
    return chunks;
}
