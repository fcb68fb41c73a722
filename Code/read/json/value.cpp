#include "read/json/value.h"

#include "base/text.h"
#include "desc/names.h"

static_assert(sizeof(JsonValue) == 24);

JsonValue::JsonValue(SourceLoc loc, std::span<const JsonMember> members)
    : loc_(loc), kind_(Kind::Object), size_(members.size()), members_(members.data()) {}

std::span<const JsonMember> JsonValue::members() const {
    return isObject() ? std::span(members_, size_) : std::span<const JsonMember>();
}

const JsonValue* JsonValue::find(std::string_view key) const {
    for (const JsonMember& member : members())
        if (member.key == key) return &member.value;
    return nullptr;
}

std::string_view nameOf(JsonValue::Kind kind) {
    constexpr std::string_view kNames[] = {"null",   "true or false", "a number",
                                           "a text", "an array",      "an object"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::string described(const JsonValue& value) {
    switch (value.kind()) {
    case JsonValue::Kind::Bool: return value.boolean() ? "true" : "false";
    case JsonValue::Kind::Number: return cat("the number ", shortest(value.number()));
    case JsonValue::Kind::String: return cat("the text '", shown(value.text()), "'");
    default: return std::string(nameOf(value.kind()));
    }
}
