// SourceFile: the text of a scene file, and the line and column of a byte in it, counted only when
// a message needs them.
#pragma once

#include "base/error.h"
#include "base/file_text.h"

#include <cstddef>
#include <string>
#include <string_view>

struct SourceFile {
    std::string name; // as the user wrote it
    FileText text;
};

// Of the byte at that offset: 1 and the line ends before it.
std::size_t lineOf(const SourceFile& source, std::size_t offset);

// "name:line:col: error: what", then the line and a caret below the column. Lines and columns count
// from 1, columns in bytes; an offset past the end means the end of the file.
std::string located(const SourceFile& source, std::size_t offset, std::string_view what,
                    std::string_view severity = "error");

[[noreturn]] void failAt(const SourceFile& source, std::size_t offset, std::string_view what);
