#include "read/nff/words.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/number.h"

#include <cmath>

std::string described(const NffWord& word) {
    return word.text.empty() ? "the end of the file" : cat("'", shown(word.text), "'");
}

bool startsNumber(const NffWord& word) {
    if (word.text.empty()) return false;
    const char c = word.text.front();
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

NffWords::NffWords(const SourceFile& source)
    : source_(source), p_(source.text.data()), end_(p_ + source.text.size()) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf"; // some editors on Windows
    if (source.text.starts_with(kByteOrderMark)) p_ += kByteOrderMark.size();
}

NffWord NffWords::next() {
    skipBlanks();
    const char* const first = p_;
    while (!isBehindWord(p_)) ++p_;
    return {static_cast<std::size_t>(first - source_.text.data()),
            {first, static_cast<std::size_t>(p_ - first)}};
}

NffWord NffWords::peek() {
    const char* const here = p_;
    const NffWord word = next();
    p_ = here;
    return word;
}

std::size_t NffWords::lineOf(std::size_t offset) const {
    return ::lineOf(source_, offset);
}

void NffWords::refuseSecond(const NffWord& word, std::size_t& given) const {
    if (given != kNotGiven)
        failAt(word, cat("'", word.text, "' was given already at line ", lineOf(given)));
    given = word.offset;
}

void NffNumbers::failMissing() {
    const NffWord word = in_.next();
    if (!word.text.empty() && readDouble(word.text.data()).fault == NumberFault::TooLarge)
        in_.failAt(word, cat(described(word), " is too large"));
    in_.failAt(word, cat("expected ", count_, count_ == 1 ? " number" : " numbers", " after '",
                         keyword_.text, "', got ", described(word), " as number ", got_ + 1));
}

void NffNumbers::addOutside(const Range& range, double value, std::size_t offset) {
    errors_.add({static_cast<std::uint32_t>(offset)}, [&] {
        return cat(count_ == 1 ? "" : cat("number ", got_, " of "), "'", keyword_.text, "' ",
                   mustBe(range, value), ", got ", shortest(value));
    });
}

int NffNumbers::whole(const Range& range) {
    const NffWord word = in_.peek();
    const double value = number(range);
    if (!range.contains(value)) return static_cast<int>(range.lo); // was told
    if (value != std::floor(value))
        errors_.add(word.loc(),
                    [&] { return cat("expected a whole number, got ", described(word)); });
    return static_cast<int>(value);
}

Vec3d NffNumbers::point() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
}

Rgbd NffNumbers::color() {
    const double r = number(kColor), g = number(kColor), b = number(kColor);
    return {r, g, b};
}

bool NffNumbers::more(std::size_t count) {
    if (!startsNumber(in_.peek())) return false;
    count_ += count;
    return true;
}
