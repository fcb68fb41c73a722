#include "read/mesh/line_reader.h"

#include "base/text.h"
#include "desc/names.h"

#include <cstring>

LineReader::LineReader(const SourceFile& source)
    : source_(&source), p_(source.text.data()), end_(p_ + source.text.size()) {
    if (source.text.starts_with("\xef\xbb\xbf")) p_ += 3; // what some editors put first
}

namespace {

// At the start of a word, or behind a number or a corner of a face: the same from wherever in the
// line one looks, so that whoever counts lines and whoever reads them find the same ones.
bool hasComment(std::string_view line) {
    for (std::size_t i = line.find('#'); i != std::string_view::npos; i = line.find('#', i + 1))
        if (i == 0 ||
            std::string_view(" \t\r0123456789./").find(line[i - 1]) != std::string_view::npos)
            return true;
    return false;
}

} // namespace

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
        const bool joins =
            last > p_ && last[-1] == '\\' && !hasComment(std::string_view(p_, newline));
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

bool LineReader::isBeyond(double largest) {
    if (atLineEnd()) return false;
    const char* const here = p_;
    const bool isNone = isNotFinite(word());
    p_ = here;
    const auto read = readDouble(p_);
    return isNone || read.fault == NumberFault::TooLarge ||
           (read.fault == NumberFault::None && isNumberEnd(read.end) &&
            std::fabs(read.value) > largest);
}

void LineReader::failNumber(std::string_view keyword, double largest) {
    const std::string found = nextWord();
    const std::size_t place = offset();
    const auto read = readDouble(p_);
    if (read.fault == NumberFault::TooLarge ||
        (read.fault == NumberFault::None && isNumberEnd(read.end)))
        failAt(place, cat(found, " is too large; at most ", shortest(largest)));
    if (isNotFinite(word())) failAt(place, cat(found, " is not a finite number"));
    failAt(place, cat("expected a number after '", keyword, "', got ", found));
}
