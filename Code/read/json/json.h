// JSON text as a tree of values (RFC 8259, strictly: no comments, no trailing commas, no NaN).
// Knows nothing about scenes.
#pragma once

#include "base/source.h"
#include "read/json/value.h"

#include <memory>
#include <memory_resource>

// Its values refer to the text of the source, which must outlive it, and to `memory`.
struct JsonDocument {
    std::unique_ptr<std::pmr::monotonic_buffer_resource> memory;
    JsonValue root;
};

inline constexpr int kDeepestJson = 256;

// Fails (failAt) on what the standard rejects, on nesting deeper than kDeepestJson, on text that is
// not UTF-8, on numbers too large for double, and on keys that an object has twice.
JsonDocument parseJson(const SourceFile& source);
