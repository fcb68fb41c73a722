// The texts of JSON between their double quotes: where they end, and what their escapes stand for.
#pragma once

#include "base/source.h"

#include <string>

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
