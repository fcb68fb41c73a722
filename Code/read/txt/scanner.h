// Scanner: the text of a native scene file as tokens and numbers that know their byte offset.
// Knows characters and lines, but no keyword.
#pragma once

#include "base/source.h"
#include "desc/names.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

enum class TokenKind { Word, Quoted, Open, Close, LineEnd, FileEnd };
struct Token {
    TokenKind kind = TokenKind::FileEnd;
    std::size_t offset = 0;
    std::string_view text; // as written, Quoted with its quotes
};

// Like ==, for words: decided by their sizes most of the time, and without a call.
inline bool isSameWord(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    // From both ends; the parts may overlap.
    const auto differ = [&](auto part) {
        const auto at = [&](std::string_view word, std::size_t from) {
            std::memcpy(&part, word.data() + from, sizeof part);
            return part;
        };
        const std::size_t last = a.size() - sizeof part;
        return ((at(a, 0) ^ at(b, 0)) | (at(a, last) ^ at(b, last))) != 0;
    };
    if (a.size() > 16) return a == b;
    if (a.size() >= 8) return !differ(std::uint64_t{});
    if (a.size() >= 4) return !differ(std::uint32_t{});
    return a.empty() ||
           (a[0] == b[0] && a[a.size() / 2] == b[a.size() / 2] && a.back() == b.back());
}

// For messages: "'abc'", "the end of the line", "the end of the file".
std::string described(const Token& token);

class Scanner {
public:
    explicit Scanner(const SourceFile& source); // the file must outlive the scanner

    const SourceFile& source() const { return source_; }
    std::size_t offset() const { return static_cast<std::size_t>(p_ - source_.text.data()); }
    void moveTo(std::size_t offset) { p_ = source_.text.data() + offset; }
    std::size_t bytesLeft() const { return source_.text.size() - offset(); }

    // Fails on characters that start no token.
    Token next() {
        skipBlanks();
        const char* const first = p_;
        while (isBareChar(*p_)) ++p_;
        if (p_ == first) return nextButWord();
        return {TokenKind::Word,
                static_cast<std::size_t>(first - source_.text.data()),
                {first, static_cast<std::size_t>(p_ - first)}};
    }
    Token peek();
    // Goes behind the end of the line when nothing else is left of it.
    bool takeLineEnd() {
        skipBlanks();
        if (*p_ != '\n') return false;
        ++p_;
        return true;
    }
    // The text from the next word of the line on.
    const char* skipToWord() {
        skipBlanks();
        return p_;
    }
    // The name that a Word or Quoted token stands for. Fails on wrong escapes, control characters
    // and bytes that are not UTF-8.
    std::string nameIn(const Token& token) const;

    // Moves over blanks, line ends and comments, and returns the text from there: for the arrays of
    // meshes, where tokens would be too slow.
    const char* skipToValue() {
        while (true) {
            const char c = *p_;
            if (c == ' ' || c == '\n' || c == '\t')
                ++p_;
            else if (c == '\r' && p_[1] == '\n')
                p_ += 2;
            else if (c == '#')
                skipComment();
            else
                return p_;
        }
    }
    void moveTo(const char* p) { p_ = p; }
    const char* textEnd() const { return end_; }
    std::string_view textLeft() const { return {p_, static_cast<std::size_t>(end_ - p_)}; }
    // Is this a byte that may follow a number?
    static bool endsNumber(char c) { return !isBareChar(c) && c != '"'; }

    [[noreturn]] void failAt(std::size_t offset, std::string_view what) const;
    // The line, from 1, for messages that point to a second place.
    std::size_t lineOf(std::size_t offset) const;

private:
    void skipBlanks() {
        while (*p_ == ' ' || *p_ == '\t' || (*p_ == '\r' && p_[1] == '\n')) ++p_;
        if (*p_ == '#') skipComment();
    }
    void skipComment();
    Token nextButWord();
    Token quoted();

    const SourceFile& source_;
    const char* p_;
    const char* end_; // *end_ is the string's terminating zero
};
