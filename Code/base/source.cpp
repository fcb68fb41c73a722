#include "base/source.h"

#include "base/text.h"

#include <algorithm>

std::string located(const SourceFile& source, std::size_t offset, std::string_view what,
                    std::string_view severity) {
    const std::string_view text = source.text;
    offset = std::min(offset, text.size());
    const std::size_t newline = offset == 0 ? std::string_view::npos : text.rfind('\n', offset - 1);
    const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
    const auto line =
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(start), '\n') + 1;
    const std::size_t col = offset - start + 1;
    std::string message = cat(source.name, ":", line, ":", col, ": ", severity, ": ", what);

    // The excerpt: at most 100 bytes around the place, control characters shown as blanks.
    constexpr std::size_t kWidth = 100;
    const std::size_t end = std::min(text.find('\n', offset), text.size());
    const std::size_t from = col > kWidth * 3 / 4 ? offset - kWidth * 3 / 4 : start;
    std::string excerpt(text.substr(from, std::min(end - from, kWidth)));
    for (char& c : excerpt)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    if (excerpt.find_first_not_of(' ') == std::string::npos) return message;
    return message + "\n  " + excerpt + "\n  " + std::string(offset - from, ' ') + "^";
}

void failAt(const SourceFile& source, std::size_t offset, std::string_view what) {
    fail(ErrorKind::Input, located(source, offset, what));
}
