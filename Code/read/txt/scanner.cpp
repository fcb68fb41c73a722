#include "read/txt/scanner.h"

#include "base/text.h"
#include "desc/names.h"

#include <cstring>

std::string described(const Token& token) {
    if (token.kind == TokenKind::LineEnd) return "the end of the line";
    if (token.kind == TokenKind::FileEnd) return "the end of the file";
    return cat("'", shown(token.text), "'");
}

Scanner::Scanner(const SourceFile& source)
    : source_(source), p_(source.text.data()), end_(p_ + source.text.size()) {}

void Scanner::failAt(std::size_t offset, std::string_view what) const {
    ::failAt(source_, offset, what);
}

std::size_t Scanner::lineOf(std::size_t offset) const { return ::lineOf(source_, offset); }

void Scanner::skipComment() {
    const void* newline = std::memchr(p_, '\n', static_cast<std::size_t>(end_ - p_));
    p_ = newline ? static_cast<const char*>(newline) : end_;
}

Token Scanner::peek() {
    const char* const here = p_;
    const Token token = next();
    p_ = here;
    return token;
}

Token Scanner::nextButWord() {
    const std::size_t start = offset();
    if (p_ == end_) return {TokenKind::FileEnd, start, {}};
    const auto one = [&](TokenKind kind) { return Token{kind, start, {p_++, 1}}; };
    if (*p_ == '\n') return one(TokenKind::LineEnd);
    if (*p_ == '{') return one(TokenKind::Open);
    if (*p_ == '}') return one(TokenKind::Close);
    if (*p_ == '"') return quoted();
    const std::string_view rest(p_, static_cast<std::size_t>(end_ - p_));
    const std::string character = shown(firstCharacter(rest));
    if (findBadText(rest.substr(0, 4)) == 0)
        failAt(start, cat("unexpected byte '", character, "'; a scene file is plain text"));
    failAt(start, cat("unexpected character '", character,
                      "'; names with such characters need double quotes"));
}

Token Scanner::quoted() {
    const char* const first = p_++;
    const auto start = static_cast<std::size_t>(first - source_.text.data());
    while (*p_ != '"') {
        if (p_ == end_ || *p_ == '\n') failAt(start, "the text is not closed; expected '\"'");
        p_ += *p_ == '\\' && p_ + 1 < end_ && p_[1] != '\n' ? 2 : 1;
    }
    ++p_;
    return {TokenKind::Quoted, start, {first, static_cast<std::size_t>(p_ - first)}};
}

std::string Scanner::nameIn(const Token& token) const {
    if (token.kind == TokenKind::Word) return std::string(token.text);
    const std::string_view inside = token.text.substr(1, token.text.size() - 2);
    if (const std::size_t bad = findBadText(inside); bad != std::string_view::npos)
        failAt(token.offset + 1 + bad, cat("unexpected byte '", shown(inside.substr(bad, 1)),
                                           "'; names are UTF-8 without control characters"));
    if (inside.find('\\') == std::string_view::npos) return std::string(inside);
    std::string name;
    name.reserve(inside.size());
    for (std::size_t i = 0; i < inside.size(); ++i) {
        if (inside[i] == '\\') {
            if (++i; inside[i] != '"' && inside[i] != '\\')
                failAt(token.offset + i, "unknown escape; only \\\" and \\\\ are known");
        }
        name += inside[i];
    }
    return name;
}
