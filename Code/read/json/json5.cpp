#include "read/json/json.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/number.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

// The blanks of more than one byte: no-break space, byte order mark, separators of lines and
// paragraphs.
constexpr std::string_view kWideBlanks[] = {"\xc2\xa0", "\xef\xbb\xbf", "\xe2\x80\xa8",
                                            "\xe2\x80\xa9"};

void appendCharacter(const SourceFile& source, const char*& p, std::string& out) {
    const std::string_view character = firstCharacter(jsonRest(source, p));
    if (static_cast<unsigned char>(*p) >= 0x80 && character.size() == 1)
        failJson(source, p, cat("byte ", shown(character), " is not UTF-8"));
    out += character;
    p += character.size();
}

// Takes the digits at p.
std::string_view digitsAt(const char*& p) {
    const char* start = p;
    while (isJsonDigit(*p)) ++p;
    return {start, static_cast<std::size_t>(p - start)};
}

// Without its sign; p moves behind it.
double hexadecimal(const char*& p) {
    double value = 0;
    for (p += 2; jsonHexDigit(*p) >= 0; ++p) value = value * 16 + jsonHexDigit(*p);
    return value;
}
double decimal(const SourceFile& source, const char*& p) {
    const char* start = p;
    const std::string_view whole = digitsAt(p);
    if (whole.size() > 1 && whole[0] == '0')
        failJson(source, start,
                 "a number has no zeros before its first digit; JSON knows no octal");
    std::string_view part;
    if (*p == '.') part = digitsAt(++p);
    if (whole.empty() && part.empty()) failJson(source, start, "a number needs a digit");
    std::string text = cat(whole, ".", part, "0");
    if (*p == 'e' || *p == 'E') {
        text += *p++;
        if (*p == '+' || *p == '-') text += *p++;
        const std::string_view power = digitsAt(p);
        if (power.empty()) failJson(source, start, "a number needs a digit in the exponent");
        text += power;
    }
    const NumberRead<double> read = readDouble(text.c_str());
    return read.fault == NumberFault::None ? read.value : HUGE_VAL;
}

} // namespace

const char* skipJson5Blanks(const SourceFile& source, const char* at) {
    const char* p = at;
    while (true) {
        const std::string_view rest = jsonRest(source, p);
        if (*p == ' ' || (*p >= '\t' && *p <= '\r')) {
            ++p;
        } else if (rest.starts_with("//")) {
            p += std::min(rest.find_first_of("\r\n"), rest.size());
        } else if (rest.starts_with("/*")) {
            const std::size_t end = rest.find("*/", 2);
            if (end == std::string_view::npos)
                failJson(source, p,
                         "the comment is not closed; expected '*/' before the end of the file");
            p += end + 2;
        } else {
            const char* before = p;
            for (const std::string_view blank : kWideBlanks)
                if (rest.starts_with(blank)) p = before + blank.size();
            if (p == before) return p;
        }
    }
}

bool beginsJson5Number(const char* at) {
    if (*at == '+' || *at == '-') ++at;
    return isJsonDigit(*at) || *at == '.' || *at == '+' || *at == '-' || *at == 'I' || *at == 'N';
}

JsonNumber readJson5Number(const SourceFile& source, const char* at) {
    const char* p = at;
    const bool isNegative = *p == '-';
    if (*p == '+' || *p == '-') ++p;
    const std::string_view rest = jsonRest(source, p);
    if (rest.starts_with("Infinity") || rest.starts_with("NaN"))
        failJson(source, at,
                 cat("expected a value, got ", jsonHere(source, at),
                     "; a scene has finite numbers only"));
    const bool isHex = p[0] == '0' && (p[1] == 'x' || p[1] == 'X') && jsonHexDigit(p[2]) >= 0;
    const double size = isHex ? hexadecimal(p) : decimal(source, p);
    if (isJsonLetter(*p) || isJsonDigit(*p) || *p == '.')
        failJson(source, at, cat("expected a number, got ", jsonHere(source, at)));
    if (size == HUGE_VAL)
        failJson(source, at, "the number is too large; at most 1.7976931348623157e308 is possible");
    return {p, isNegative ? -size : size};
}

const char* readJson5Text(const SourceFile& source, const char* at, std::string& out) {
    constexpr std::string_view kEscapes = "bfnrtv0", kMeanings("\b\f\n\r\t\v\0", 7);
    const char* p = at + 1;
    while (*p != *at) {
        const std::string_view rest = jsonRest(source, p);
        if (rest.empty() || *p == '\n' || *p == '\r')
            failJson(source, at,
                     cat("the text is not closed; expected ", *at == '"' ? "'\"'" : "\"'\"",
                         " before the end of the line"));
        if (*p != '\\') {
            appendCharacter(source, p, out);
        } else if (rest.starts_with("\\\r\n")) { // the text goes on in the next line
            p += 3;
        } else if (p[1] == '\n' || p[1] == '\r') {
            p += 2;
        } else if (p[1] == 'u') {
            p = appendJsonUnicode(source, p + 2, source.text.data() + source.text.size(), out);
        } else if (p[1] == 'x') {
            if (jsonHexDigit(p[2]) < 0 || jsonHexDigit(p[3]) < 0)
                failJson(source, p, "expected two hexadecimal digits after '\\x'");
            appendUtf8(out,
                       static_cast<std::uint32_t>(jsonHexDigit(p[2]) * 16 + jsonHexDigit(p[3])));
            p += 4;
        } else {
            const std::size_t escape = kEscapes.find(p[1]);
            if (isJsonDigit(p[1]) && (p[1] != '0' || isJsonDigit(p[2])))
                failJson(source, p, "a '\\' before a digit means nothing");
            ++p;
            if (escape != std::string_view::npos)
                out += kMeanings[escape], ++p;
            else if (rest.size() > 1) // other characters stand for themselves
                appendCharacter(source, p, out);
        }
    }
    return p + 1;
}

const char* endOfJson5Key(const char* at) {
    const char* p = at;
    while (isJsonLetter(*p) || *p == '$' || (p != at && isJsonDigit(*p))) ++p;
    return p;
}
