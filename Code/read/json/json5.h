// The tokens of JSON5 (json5.org) where it is wider than JSON: comments, texts in single quotes,
// keys without quotes, numbers with a sign, in hexadecimal, or that begin or end with their point.
// The programs of the course read it since autumn 2024.
#pragma once

#include "read/json/tokens.h"

// Behind blanks and comments. Fails on a comment that is not closed.
const char* skipJson5Blanks(const SourceFile& source, const char* at);

// Does a number of JSON5 begin there? Infinity and NaN are numbers that readJson5Number() refuses.
bool beginsJson5Number(const char* at);
JsonNumber readJson5Number(const SourceFile& source, const char* at);

// Appends what a text means that begins with the quote at `at`, single or double; returns the place
// behind it. Fails as readJsonText() and decodeJsonText() do.
const char* readJson5Text(const SourceFile& source, const char* at, std::string& out);

// Behind a key without quotes, of letters, digits, '_' and '$'; `at` itself if none begins there.
const char* endOfJson5Key(const char* at);
