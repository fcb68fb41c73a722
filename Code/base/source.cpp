#include "base/source.h"

#include "base/text.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

std::size_t lineOf(const SourceFile& source, std::size_t offset) {
    // By the compiler's vectors, each lane of which counts up to kTogether: a twelfth of the time
    // of std::count(), which is a millisecond in a file of some megabytes.
    using Lanes __attribute__((vector_size(16))) = std::uint8_t;
    constexpr std::size_t kTogether = 128;
    std::string_view before = std::string_view(source.text).substr(0, offset);
    std::size_t line = 1;
    for (; before.size() >= kTogether * sizeof(Lanes);
         before.remove_prefix(kTogether * sizeof(Lanes))) {
        Lanes ends{};
        for (std::size_t i = 0; i < kTogether; ++i) {
            Lanes bytes;
            std::memcpy(&bytes, before.data() + i * sizeof bytes, sizeof bytes);
            ends -= reinterpret_cast<Lanes>(bytes == '\n'); // -1 where it is
        }
        for (std::size_t k = 0; k < sizeof ends; ++k) line += ends[k];
    }
    return line + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string located(const SourceFile& source, std::size_t offset, std::string_view what,
                    std::string_view severity) {
    const std::string_view text = source.text;
    if (text.empty() && offset > 0) return cat(source.name, ": ", severity, ": ", what);
    offset = std::min(offset, text.size());
    const std::size_t newline = offset == 0 ? std::string_view::npos : text.rfind('\n', offset - 1);
    const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
    const std::size_t line = lineOf(source, start);
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
