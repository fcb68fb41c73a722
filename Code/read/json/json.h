// JSON text as a tree of values (RFC 8259; JSON5 where it is wanted), which knows nothing about
// scenes; and the dialects of the course's scenes, told apart by the keys that they use.
#pragma once

#include "base/source.h"
#include "base/vec.h"
#include "desc/scene_desc.h"
#include "read/json/tokens.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct JsonMember;

// Three words, never changed once made. What it holds more lies in the document or in its text.
class JsonValue {
public:
    enum class Kind : std::uint8_t { Null, Bool, Number, String, Array, Object };

    JsonValue() : JsonValue(SourceLoc{}) {}
    explicit JsonValue(SourceLoc loc) : loc_(loc), number_(0) {}
    JsonValue(SourceLoc loc, bool value) : loc_(loc), kind_(Kind::Bool), boolean_(value) {}
    JsonValue(SourceLoc loc, double value) : loc_(loc), kind_(Kind::Number), number_(value) {}
    JsonValue(SourceLoc loc, std::string_view text)
        : loc_(loc), kind_(Kind::String), size_(text.size()), text_(text.data()) {}
    JsonValue(SourceLoc loc, std::span<const JsonValue> items)
        : loc_(loc), kind_(Kind::Array), size_(items.size()), items_(items.data()) {}
    JsonValue(SourceLoc loc, std::span<const JsonMember> members);

    Kind kind() const { return kind_; }
    SourceLoc loc() const { return loc_; } // of its first byte
    bool isNull() const { return kind_ == Kind::Null; }
    bool isNumber() const { return kind_ == Kind::Number; }
    bool isString() const { return kind_ == Kind::String; }
    bool isArray() const { return kind_ == Kind::Array; }
    bool isObject() const { return kind_ == Kind::Object; }

    // Of another kind: false, 0, empty.
    bool boolean() const { return kind_ == Kind::Bool && boolean_; }
    double number() const { return isNumber() ? number_ : 0; }
    std::string_view text() const { // decoded, UTF-8
        return isString() ? std::string_view(text_, size_) : std::string_view();
    }
    std::span<const JsonValue> items() const {
        return isArray() ? std::span(items_, size_) : std::span<const JsonValue>();
    }
    std::span<const JsonMember> members() const; // in the order of the file; keys are unique

    // The value of a key of an object; nullptr when it has none.
    const JsonValue* find(std::string_view key) const;

private:
    SourceLoc loc_;
    Kind kind_ = Kind::Null;
    std::size_t size_ = 0; // of the text, the items or the members
    union {
        bool boolean_;
        double number_;
        const char* text_;
        const JsonValue* items_;
        const JsonMember* members_;
    };
};
struct JsonMember {
    std::string_view key;
    SourceLoc loc; // of the key
    JsonValue value;
};

// "a number", "an object"
std::string_view nameOf(JsonValue::Kind kind);
// For messages: "the number 12", "the text 'abc'", "true", "an array".
std::string described(const JsonValue& value);

// Something that a text is read in spite of, for a warning: at `loc`, in words.
struct JsonLiberty {
    SourceLoc loc;
    std::string what;
};
// Its values refer to the text of the source, which must outlive it, and to `memory`.
struct JsonDocument {
    std::unique_ptr<std::pmr::monotonic_buffer_resource> memory;
    JsonValue root;
    std::vector<JsonLiberty> liberties;
};
// Standard: none, as the standard says. Json5: the first place where the text is JSON5 and no JSON.
// Lenient: that, and keys that an object has twice, of which the last one holds.
enum class JsonGrammar { Standard, Json5, Lenient };

inline constexpr int kDeepestJson = 256;

// Fails (failAt) on what the standard rejects, on nesting deeper than kDeepestJson, on text that is
// not UTF-8, on numbers too large for double, and on keys that an object has twice.
JsonDocument parseJson(const SourceFile& source, JsonGrammar grammar = JsonGrammar::Standard);

// The tokens of JSON5 (json5.org) where it is wider than JSON: comments, texts in single quotes,
// keys without quotes, numbers with a sign, in hexadecimal, or that begin or end with their point.
// The programs of the course read it since autumn 2024.

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

// The rules in which the dialects differ; no other file tells them apart.
struct JsonRules {
    Vec3d attenuation;        // of a light that gives none
    bool directionalHasPower; // or its power is 1, whatever the file says
    bool refReplaces;         // the transform of a node with 'ref' replaces, or multiplies
    bool meshMovesFirst;      // a mesh is (v + position) * scale, or T * R * S
    bool allArePlaced;        // boxes and planes have position, rotation and scale like all others
    int width, height;        // of a picture without 'resolution'
};

JsonRules jsonRulesOf(const JsonValue& scene);
