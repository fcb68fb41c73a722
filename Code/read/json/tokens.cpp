#include "read/json/tokens.h"

#include "base/text.h"
#include "desc/names.h"

#include <array>
#include <cstdint>
#include <optional>

namespace {

// Bytes that stand for themselves: ASCII but control characters, quote and backslash.
constexpr auto kPlain = [] {
    std::array<bool, 256> plain{};
    for (std::size_t c = 0x20; c < 0x80; ++c) plain[c] = c != '"' && c != '\\';
    return plain;
}();

std::optional<std::uint32_t> hex4(const char* p, const char* end) {
    if (end - p < 4) return {};
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) {
        const int digit = jsonHexDigit(p[i]);
        if (digit < 0) return {};
        value = value * 16 + static_cast<std::uint32_t>(digit);
    }
    return value;
}

bool isHighSurrogate(std::uint32_t code) { return code >= 0xd800 && code < 0xdc00; }
bool isLowSurrogate(std::uint32_t code) { return code >= 0xdc00 && code < 0xe000; }

} // namespace

void appendUtf8(std::string& out, std::uint32_t code) {
    const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((code >> shift) & 0x3f)); };
    if (code < 0x80) {
        out += static_cast<char>(code);
    } else if (code < 0x800) {
        out += static_cast<char>(0xc0 | (code >> 6));
        tail(0);
    } else if (code < 0x10000) {
        out += static_cast<char>(0xe0 | (code >> 12));
        tail(6), tail(0);
    } else {
        out += static_cast<char>(0xf0 | (code >> 18));
        tail(12), tail(6), tail(0);
    }
}

const char* appendJsonUnicode(const SourceFile& source, const char* p, const char* end,
                              std::string& out) {
    const char* start = p - 2;
    const auto code = hex4(p, end);
    if (!code) failJson(source, start, "expected four hexadecimal digits after '\\u'");
    p += 4;
    if (!isHighSurrogate(*code) && !isLowSurrogate(*code)) {
        appendUtf8(out, *code);
        return p;
    }
    const bool hasSecond = end - p >= 6 && p[0] == '\\' && p[1] == 'u';
    const auto low = hasSecond ? hex4(p + 2, end) : std::nullopt;
    if (!isHighSurrogate(*code) || !low || !isLowSurrogate(*low))
        failJson(source, start,
                 cat("'", std::string_view(start, 6),
                     "' is half of a surrogate pair; the other half is missing"));
    appendUtf8(out, 0x10000 + ((*code - 0xd800) << 10) + (*low - 0xdc00));
    return p + 6;
}

std::string jsonHere(const SourceFile& source, const char* at) {
    const std::string_view rest = jsonRest(source, at);
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
    failJson(source, at, cat("expected a value, got ", here, hint));
}

const char* endOfJsonWord(const SourceFile& source, const char* at, std::string_view word) {
    const std::string_view rest = jsonRest(source, at);
    const std::size_t size = word.size();
    if (!rest.starts_with(word) || isJsonLetter(at[size]) || isJsonDigit(at[size]))
        failNoJsonValue(source, at);
    return at + size;
}

JsonNumber readAnyJsonNumber(const SourceFile& source, const char* at) {
    const char* p = at;
    const auto digits = [&](std::string_view where) {
        if (!isJsonDigit(*p)) failJson(source, at, cat("a number needs a digit ", where));
        while (isJsonDigit(*p)) ++p;
    };
    if (*p == '-') ++p;
    const char* whole = p;
    digits("after '-'");
    if (*whole == '0' && p > whole + 1)
        failJson(source, at, "a number has no zeros before its first digit; JSON knows no octal");
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
        failJson(source, at,
                 cat("expected a number, got ", jsonHere(source, at),
                     isHex ? "; JSON has decimal numbers only" : ""));
    }
    const NumberRead<double> read = readDouble(at);
    if (read.fault == NumberFault::TooLarge)
        failJson(source, at, "the number is too large; at most 1.7976931348623157e308 is possible");
    return {p, read.value};
}

JsonText readJsonText(const SourceFile& source, const char* quote) {
    const char* const last = source.text.data() + source.text.size();
    JsonText text{quote + 1, nullptr, false};
    const char* p = text.begin;
    while (true) {
        while (kPlain[static_cast<unsigned char>(*p)]) ++p;
        if (*p == '"') {
            text.end = p + 1;
            return text;
        }
        const auto byte = static_cast<unsigned char>(*p);
        if (p == last || byte == '\n')
            failJson(source, quote,
                     "the text is not closed; expected '\"' before the end of the "
                     "line (a line end inside is written \\n)");
        if (byte == '\\') {
            text.hasEscapes = true;
            p += p[1] == '"' || p[1] == '\\' ? 2 : 1; // other escapes are looked at later
        } else if (byte < 0x20) {
            failJson(source, p,
                     cat("control character ", shown({p, 1}),
                         " in a text; write it as \\t or \\u00", shown({p, 1}).substr(2)));
        } else {
            const std::size_t length =
                firstCharacter({p, static_cast<std::size_t>(last - p)}).size();
            if (length == 1) failJson(source, p, cat("byte ", shown({p, 1}), " is not UTF-8"));
            p += length;
        }
    }
}

void decodeJsonText(const SourceFile& source, const JsonText& text, std::string& out) {
    constexpr std::string_view kEscapes = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    const char* const end = text.end - 1;
    for (const char* p = text.begin; p < end;) {
        if (*p != '\\') {
            out += *p++;
        } else if (p[1] == 'u') {
            p = appendJsonUnicode(source, p + 2, end, out);
        } else {
            const std::size_t escape = kEscapes.find(p[1]);
            if (escape == std::string_view::npos)
                failJson(source, p,
                         cat("unknown escape '\\",
                             shown(firstCharacter({p + 1, static_cast<std::size_t>(end - p - 1)})),
                             "'; known: \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX"));
            out += kMeanings[escape];
            p += 2;
        }
    }
}
