#include "read/nff/split.h"

namespace {

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool startsEntity(std::string_view line) {
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    if (line.starts_with("pp")) line.remove_prefix(1);
    return line.size() >= 2 &&
           std::string_view("vblfscp").find(line[0]) != std::string_view::npos && isBlank(line[1]);
}

} // namespace

std::vector<std::size_t> nffPartStarts(std::string_view text, std::size_t partBytes) {
    std::vector<std::size_t> starts{0};
    for (std::size_t at = partBytes; at < text.size();) {
        const std::size_t newline = text.find('\n', at);
        if (newline == std::string_view::npos) break;
        at = newline + 1;
        if (!startsEntity(text.substr(at))) continue;
        starts.push_back(at);
        at += partBytes;
    }
    return starts;
}

std::optional<std::size_t> lastNffFill(std::string_view text, std::size_t first, std::size_t last) {
    for (std::size_t end = last; end > first; --end) {
        const std::size_t i = end - 1;
        if (text[i] != 'f' || i + 1 >= last || !isBlank(text[i + 1])) continue;
        std::size_t before = i;
        while (before > first && (text[before - 1] == ' ' || text[before - 1] == '\t')) --before;
        if (before == 0 || text[before - 1] == '\n') return i;
    }
    return {};
}
