// NffWords: the text of an NFF file as words and numbers that know their place. NFF is read by word
// and not by line: the standard's text shows a cone on three lines, its programs write it on one or
// two. '#' starts a comment that runs to the end of its line, anywhere.
#pragma once

#include "base/source.h"
#include "base/vec.h"
#include "desc/validate.h"
#include "desc/range.h"
#include "desc/scene_desc.h"
#include "read/plain_number.h"

#include <cstddef>
#include <string>
#include <string_view>

struct NffWord {
    std::size_t offset = 0;
    std::string_view text; // empty at the end of the file
    SourceLoc loc() const { return {static_cast<std::uint32_t>(offset)}; }
};

// For messages: "'abc'", "the end of the file".
std::string described(const NffWord& word);
bool startsNumber(const NffWord& word);

class NffWords {
public:
    explicit NffWords(const SourceFile& source); // the file must outlive the words

    const SourceFile& source() const { return source_; }
    NffWord next();
    NffWord peek();
    std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - p_); }

    // Moves behind the next number. False, and no move, when there is none or it is too large.
    bool number(double& value, std::size_t& offset);

    [[noreturn]] void failAt(const NffWord& word, std::string_view what) const {
        ::failAt(source_, word.offset, what);
    }
    std::size_t lineOf(std::size_t offset) const;
    // For words that may stand once: `given` is the place of the first.
    static constexpr std::size_t kNotGiven = static_cast<std::size_t>(-1);
    void refuseSecond(const NffWord& word, std::size_t& given) const;

private:
    static constexpr bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    void skipBlanks();
    bool isBehindWord(const char* p) const { return isBlank(*p) || *p == '#' || p == end_; }

    const SourceFile& source_;
    const char* p_;
    const char* end_; // *end_ is the string's terminating zero
};

inline void NffWords::skipBlanks() {
    while (true) {
        while (isBlank(*p_)) ++p_;
        if (*p_ != '#') return;
        while (p_ != end_ && *p_ != '\n' && *p_ != '\r') ++p_;
    }
}

inline bool NffWords::number(double& value, std::size_t& offset) {
    skipBlanks();
    const NumberRead<double> read = readDouble(p_, end_);
    if (read.fault != NumberFault::None || !isBehindWord(read.end)) return false;
    value = read.value;
    offset = static_cast<std::size_t>(p_ - source_.text.data());
    p_ = read.end;
    return true;
}

// The numbers behind a keyword. Missing ones stop the reader; those out of range are collected.
class NffNumbers {
public:
    NffNumbers(NffWords& in, ErrorList& errors, const NffWord& keyword, std::size_t count)
        : in_(in), errors_(errors), keyword_(keyword), count_(count) {}

    double number(const Range& range = kAnyNumber) {
        double value = 0;
        std::size_t offset = 0;
        if (!in_.number(value, offset)) failMissing();
        ++got_;
        if (!range.contains(value)) addOutside(range, value, offset);
        return value;
    }
    int whole(const Range& range); // of a range that fits
    Vec3d point();
    Rgbd color();
    // For keywords that may have more numbers, and do when another one follows.
    bool more(std::size_t count);

private:
    [[noreturn]] void failMissing();
    void addOutside(const Range& range, double value, std::size_t offset);

    NffWords& in_;
    ErrorList& errors_;
    const NffWord& keyword_;
    std::size_t count_, got_ = 0;
};
