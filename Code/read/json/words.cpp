#include "read/json/words.h"

#include "base/text.h"
#include "desc/names.h"

namespace {

std::string_view restOf(const SourceFile& source, const char* at) {
    return std::string_view(source.text).substr(static_cast<std::size_t>(at - source.text.data()));
}

[[noreturn]] void fail(const SourceFile& source, const char* at, std::string_view what) {
    failAt(source, static_cast<std::size_t>(at - source.text.data()), what);
}

} // namespace

std::string jsonHere(const SourceFile& source, const char* at) {
    const std::string_view rest = restOf(source, at);
    if (rest.empty()) return "the end of the file";
    const auto inWord = [](char c) {
        return isJsonLetter(c) || isJsonDigit(c) || c == '.' || c == '+' || c == '-';
    };
    // A word or number whole, else one character.
    std::size_t size = 0;
    while (size < rest.size() && size < 40 && inWord(rest[size])) ++size;
    return cat("'", shown(size > 0 ? rest.substr(0, size) : firstCharacter(rest)), "'");
}

void failNoJsonValue(const SourceFile& source, const char* at) {
    std::string hint;
    const std::string here = jsonHere(source, at);
    if (*at == '\'')
        hint = "; texts stand in double quotes";
    else if (*at == '/' || *at == '#')
        hint = "; JSON has no comments";
    else if (*at == '+' || *at == '.')
        hint = "; a number starts with a digit or '-'";
    else if (here == "'True'" || here == "'False'" || here == "'None'")
        hint = "; JSON writes true, false and null";
    else if (here == "'NaN'" || here == "'Infinity'" || here == "'inf'" || here == "'nan'")
        hint = "; JSON has finite numbers only";
    else if (isJsonLetter(*at))
        hint = "; texts stand in double quotes, and the words are true, false and null";
    fail(source, at, cat("expected a value, got ", here, hint));
}

const char* endOfJsonWord(const SourceFile& source, const char* at, std::string_view word) {
    const std::string_view rest = restOf(source, at);
    const std::size_t size = word.size();
    if (!rest.starts_with(word) || isJsonLetter(at[size]) || isJsonDigit(at[size]))
        failNoJsonValue(source, at);
    return at + size;
}

JsonNumber readAnyJsonNumber(const SourceFile& source, const char* at) {
    const char* p = at;
    const auto digits = [&](std::string_view where) {
        if (!isJsonDigit(*p)) fail(source, at, cat("a number needs a digit ", where));
        while (isJsonDigit(*p)) ++p;
    };
    if (*p == '-') ++p;
    const char* whole = p;
    digits("after '-'");
    if (*whole == '0' && p > whole + 1)
        fail(source, at, "a number has no zeros before its first digit; JSON knows no octal");
    if (*p == '.') {
        ++p;
        digits("after the decimal point");
    }
    if (*p == 'e' || *p == 'E') {
        ++p;
        if (*p == '+' || *p == '-') ++p;
        digits("in the exponent");
    }
    if (isJsonLetter(*p) || *p == '.') {
        const bool isHex = *p == 'x' || *p == 'X';
        fail(source, at,
             cat("expected a number, got ", jsonHere(source, at),
                 isHex ? "; JSON has decimal numbers only" : ""));
    }
    const NumberRead<double> read = readDouble(at);
    if (read.fault == NumberFault::TooLarge)
        fail(source, at, "the number is too large; at most 1.7976931348623157e308 is possible");
    return {p, read.value};
}
