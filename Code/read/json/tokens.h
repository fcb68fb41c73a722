// The numbers, words and texts of JSON, and what to say of a place where something else stands.
#pragma once

#include "base/source.h"
#include "read/plain_number.h"

#include <cstdint>
#include <string>
#include <string_view>

// All places are in the text of the source, which ends in the zero of std::string: it begins
// nothing.

inline bool isJsonDigit(char c) { return c >= '0' && c <= '9'; }
inline bool isJsonLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

constexpr int jsonHexDigit(char c) { // -1: none
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

inline std::string_view jsonRest(const SourceFile& source, const char* at) {
    return std::string_view(source.text).substr(static_cast<std::size_t>(at - source.text.data()));
}
[[noreturn]] inline void failJson(const SourceFile& source, const char* at, std::string_view what) {
    failAt(source, static_cast<std::size_t>(at - source.text.data()), what);
}

// What stands there, for messages: "the end of the file", "'tru'", "'{'".
std::string jsonHere(const SourceFile& source, const char* at);

// No value begins there: fails, and says what may have been meant.
[[noreturn]] void failNoJsonValue(const SourceFile& source, const char* at);

// Behind the word; no value begins there if it is another one.
const char* endOfJsonWord(const SourceFile& source, const char* at, std::string_view word);

struct JsonNumber {
    const char* end = nullptr;
    double value = 0;
};
// -? (0 | [1-9][0-9]*) (. [0-9]+)? ([eE] [+-]? [0-9]+)?, that is in the range of double. Begins
// with '-' or a digit.
JsonNumber readAnyJsonNumber(const SourceFile& source, const char* at);
inline JsonNumber readJsonNumber(const SourceFile& source, const char* at) {
    JsonNumber number;
    number.end = readPlainNumber(at, source.text.data() + source.text.size(), number.value);
    if (number.end && !isJsonLetter(*number.end) && *number.end != '.') return number;
    return readAnyJsonNumber(source, at);
}

// A text between its double quotes.
struct JsonText {
    const char* begin = nullptr; // behind the opening quote
    const char* end = nullptr;   // behind the closing quote
    bool hasEscapes = false;
};

// `quote` points into the text of the source, at the opening quote. Fails on control characters, on
// what is not UTF-8, and when the text is not closed. Escapes are only skipped.
JsonText readJsonText(const SourceFile& source, const char* quote);

// Appends what the text stands for, in UTF-8. Fails on unknown escapes and on half surrogate pairs.
void decodeJsonText(const SourceFile& source, const JsonText& text, std::string& out);

// Appends a code point in UTF-8.
void appendUtf8(std::string& out, std::uint32_t code);
// Appends the code point of an escape; p is behind "\u" and the text ends at `end`. Returns the
// place behind its digits, of the second escape too where there are two.
const char* appendJsonUnicode(const SourceFile& source, const char* p, const char* end,
                              std::string& out);
