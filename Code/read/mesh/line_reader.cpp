#include "read/mesh/line_reader.h"

#include "base/text.h"
#include "desc/names.h"

#include <cstring>

LineReader::LineReader(const SourceFile& source)
    : source_(&source), p_(source.text.data()), end_(p_ + source.text.size()) {
    if (source.text.starts_with("\xef\xbb\xbf")) p_ += 3; // what some editors put first
}

void LineReader::skipLine() {
    while (true) {
        const void* const found = std::memchr(p_, '\n', static_cast<std::size_t>(end_ - p_));
        if (!found) {
            p_ = end_;
            return;
        }
        const char* const newline = static_cast<const char*>(found);
        const char* last = newline;
        if (last > p_ && last[-1] == '\r') --last;
        const bool joins = last > p_ && last[-1] == '\\' && *p_ != '#' &&
                           std::string_view(p_, newline).find(" #") == std::string_view::npos;
        p_ = newline + 1;
        if (!joins) return;
    }
}

std::string_view LineReader::rest() {
    if (atLineEnd()) return {};
    const char* const first = p_;
    const char* last = p_; // behind the last byte that is no blank
    while (!atLineEnd()) {
        while (!isWordEnd(p_)) ++p_;
        last = p_;
    }
    return {first, static_cast<std::size_t>(last - first)};
}

bool LineReader::atNumber() {
    if (atLineEnd()) return false;
    const auto read = readDouble(p_);
    return read.fault == NumberFault::None && isNumberEnd(read.end);
}

std::string LineReader::nextWord() {
    if (atLineEnd()) return p_ == end_ ? "the end of the file" : "the end of the line";
    const char* const here = p_;
    std::string shownWord = cat("'", shown(word()), "'");
    p_ = here;
    return shownWord;
}

void LineReader::failNumber(std::string_view keyword, double largest) {
    const std::string found = nextWord();
    const std::size_t place = offset();
    const auto read = readDouble(p_);
    if (read.fault == NumberFault::TooLarge ||
        (read.fault == NumberFault::None && isNumberEnd(read.end)))
        failAt(place, cat(found, " is too large; at most ", shortest(largest)));
    std::string letters; // what other programs write for numbers, but no mesh can mean
    for (const char c : word().substr(0, 10))
        if (c != '+' && c != '-') letters += static_cast<char>(c | 0x20);
    if (letters == "nan" || letters == "inf" || letters == "infinity" || letters == "nan(ind)")
        failAt(place, cat(found, " is not a finite number"));
    failAt(place, cat("expected a number after '", keyword, "', got ", found));
}
