// JSON text as a tree of values that know where they stand (RFC 8259, strictly: no comments, no
// trailing commas, no NaN). Knows nothing about scenes.
#pragma once

#include "base/source.h"
#include "desc/scene_desc.h"

#include <string>
#include <string_view>
#include <vector>

struct JsonMember;
struct JsonValue {
    enum class Kind { Null, Bool, Number, String, Array, Object };
    Kind kind = Kind::Null;
    SourceLoc loc; // of its first byte
    bool boolean = false;
    double number = 0;
    std::string text;                // String: decoded, UTF-8
    std::vector<JsonValue> items;    // Array
    std::vector<JsonMember> members; // Object, in the order of the file; keys are unique

    const JsonMember* find(std::string_view key) const;
};
struct JsonMember {
    std::string key;
    SourceLoc loc; // of the key
    JsonValue value;
};

std::string_view nameOf(JsonValue::Kind kind); // "a number", "an object"

inline constexpr int kDeepestJson = 256;

// Fails (failAt) on what the standard rejects, on nesting deeper than kDeepestJson, on text that is
// not UTF-8, on numbers too large for double, and on keys that an object has twice.
JsonValue parseJson(const SourceFile& source);
