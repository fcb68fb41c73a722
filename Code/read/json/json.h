// JSON text as a tree of values (RFC 8259, strictly: no comments, no trailing commas, no NaN).
// Knows nothing about scenes.
#pragma once

#include "base/source.h"
#include "read/json/array_scan.h"
#include "read/json/value.h"

#include <functional>
#include <memory>
#include <memory_resource>
#include <string_view>

// Its values refer to the text of the source, which must outlive it, and to `memory`.
struct JsonDocument {
    std::unique_ptr<std::pmr::monotonic_buffer_resource> memory;
    JsonValue root;
};

inline constexpr int kDeepestJson = 256;

// Fails (failAt) on what the standard rejects, on nesting deeper than kDeepestJson, on text that is
// not UTF-8, on numbers too large for double, and on keys that an object has twice.
JsonDocument parseJson(const SourceFile& source);

// The same but for a long array among the values of the outermost object: it is empty there, and
// its items are for parseJsonItems() to read. They are not looked at: mistakes in them are found
// when they are read, and by parseJson().
struct JsonOutline {
    JsonDocument document;
    JsonArrayScan list; // without parts when there is no such array, or no array or object in it
};
JsonOutline parseJsonOutline(const SourceFile& source, std::string_view listKey,
                             std::size_t partBytes);

// Calls with one item after the other. They live until the next one is read. Fails as parseJson().
void parseJsonItems(const SourceFile& source, const JsonPart& part,
                    const std::function<void(const JsonValue&)>& use);
// The item of such an array that begins there.
JsonDocument parseJsonItem(const SourceFile& source, SourceLoc loc);
