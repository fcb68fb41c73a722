// LineReader: the text of OBJ and MTL files, where a line is a statement whose first word says what
// the rest is. A backslash at the end of a line joins the next one; '#' begins a comment at the
// start of a word and behind a number, but not within a name. Knows no statement.
#pragma once

#include "base/source.h"
#include "read/number.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

class LineReader {
public:
    explicit LineReader(const SourceFile& source); // the file must outlive the reader
    // For some lines of it: `last` is the end, or the start of a line that begins with no blank.
    LineReader(const SourceFile& source, const char* first, const char* last)
        : source_(&source), p_(first), end_(last) {}

    // Goes to the first word of the next line that has one, from wherever the reader is in its
    // line. False at the end of the file.
    bool nextLine() {
        if (!atStart_) skipLine();
        atStart_ = false;
        while (atLineEnd()) {
            if (p_ == end_) return false;
            skipLine();
        }
        return true;
    }

    const char* text() const { return p_; } // of this line, not yet read
    const char* end() const { return end_; }
    std::size_t offset() const { return offsetOf(p_); }
    std::size_t offsetOf(const char* p) const {
        return static_cast<std::size_t>(p - source_->text.data());
    }
    std::size_t offsetOf(std::string_view part) const { return offsetOf(part.data()); }
    // Is the next word exactly this? Then the reader is behind it.
    template <std::size_t kSize> bool take(const char (&word)[kSize]) {
        constexpr std::size_t kLength = kSize - 1;
        skipBlanks();
        if (static_cast<std::size_t>(end_ - p_) < kLength) return false;
        for (std::size_t i = 0; i < kLength; ++i) // one or two: no call
            if (p_[i] != word[i]) return false;
        if (!isWordEnd(p_ + kLength)) return false;
        p_ += kLength;
        return true;
    }

    // Moves over blanks; is there nothing left of the line but a comment?
    bool atLineEnd() {
        skipBlanks();
        return *p_ == '\n' || *p_ == '#' || p_ == end_;
    }
    // The next word of the line, empty when there is none.
    std::string_view word() {
        if (atLineEnd()) return {};
        const char* const first = p_;
        while (!isWordEnd(p_)) ++p_;
        return {first, static_cast<std::size_t>(p_ - first)};
    }
    // The rest of the line without blanks around it and without a comment: names may have blanks.
    std::string_view rest();

    // A number of the statement `keyword`, not beyond `largest`; fails with its place.
    template <class T> T number(std::string_view keyword, double largest) {
        T value{};
        if (!takeNumber(value, largest)) failNumber(keyword, largest);
        return value;
    }
    // The same, or NaN where a number stands that is not finite or beyond `largest`.
    template <class T> T numberOrNan(std::string_view keyword, double largest) {
        T value{};
        if (!takeNumber(value, largest)) {
            if (!isBeyond(largest)) failNumber(keyword, largest);
            word();
            value = std::numeric_limits<T>::quiet_NaN();
        }
        return value;
    }
    // Is the next word of the line a number?
    bool atNumber();

    void moveTo(const char* p) { p_ = p; }
    // To the start of a line: the next one, for who has read all of this one.
    void moveToLine(const char* start) { p_ = start, atStart_ = true; }
    bool isNumberEnd(const char* p) const { return isWordEnd(p) || *p == '#'; }
    // For messages about the next word: "'abc'", "the end of the line".
    std::string nextWord();
    [[noreturn]] void failAt(std::size_t offset, std::string_view what) const {
        ::failAt(*source_, offset, what);
    }

private:
    // Blanks and line ends end words; a backslash does where it joins lines.
    bool isWordEnd(const char* p) const {
        return *p == ' ' || *p == '\n' || *p == '\t' || *p == '\r' || p == end_ || joinLength(p);
    }
    // The length of a backslash with the line end that it takes away; 0 when it is none.
    static std::size_t joinLength(const char* p) {
        if (*p != '\\') return 0;
        if (p[1] == '\n') return 2;
        return p[1] == '\r' && p[2] == '\n' ? 3 : 0;
    }
    void skipBlanks() {
        while (true) {
            if (*p_ == ' ' || *p_ == '\t' || *p_ == '\r')
                ++p_;
            else if (const std::size_t length = joinLength(p_))
                p_ += length;
            else
                return;
        }
    }
    void skipLine();
    // Moves behind the next word if it is a number that is not beyond `largest`.
    template <class T> bool takeNumber(T& value, double largest) {
        skipBlanks();
        NumberRead<T> read;
        if constexpr (std::is_same_v<T, float>)
            read = readFloat(p_);
        else
            read = readDouble(p_);
        if (read.fault != NumberFault::None || !isNumberEnd(read.end) ||
            !(std::fabs(static_cast<double>(read.value)) <= largest))
            return false;
        p_ = read.end;
        value = read.value;
        return true;
    }
    // Is the next word a number that is not finite or beyond `largest`?
    bool isBeyond(double largest);
    [[noreturn]] void failNumber(std::string_view keyword, double largest);

    const SourceFile* source_;
    const char* p_;
    const char* end_; // *end_ is the string's terminating zero, or the start of a line
    bool atStart_ = true;
};
