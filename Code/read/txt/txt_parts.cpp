#include "read/txt/txt_parts.h"

#include <cstring>

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }

// Behind the line of the first '}' from `p` on that is the first of its line; the end when there is
// none. A line does not begin in a name or comment: they end with their lines.
const char* blockEndFrom(const char* begin, const char* p, const char* end) {
    while (true) {
        const void* const found = std::memchr(p, '}', static_cast<std::size_t>(end - p));
        if (!found) return end;
        const char* const brace = static_cast<const char*>(found);
        const char* before = brace;
        while (before > begin && isBlank(before[-1])) --before;
        p = brace + 1;
        if (before > begin && before[-1] != '\n') continue;
        const void* const newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
        return newline ? static_cast<const char*>(newline) + 1 : end;
    }
}

} // namespace

std::vector<TxtPart> partsOf(std::string_view text, std::size_t first, std::size_t partBytes,
                             int threads) {
    std::vector<TxtPart> parts;
    const char* const begin = text.data();
    const char* const end = begin + text.size();
    for (const char* p = begin + first; p < end;) {
        const auto left = static_cast<std::size_t>(end - p);
        const char* const last = left <= partBytes ? end : blockEndFrom(begin, p + partBytes, end);
        TxtPart part;
        part.first = static_cast<std::size_t>(p - begin);
        part.last = static_cast<std::size_t>(last - begin);
        if ((part.last - part.first) * static_cast<std::size_t>(threads) > text.size())
            part.threads = threads;
        parts.push_back(part);
        p = last;
    }
    return parts;
}
