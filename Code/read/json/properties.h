// The keys of an object in JSON that are rows of desc/properties.h. One value stands alone, several
// stand in an array: "radius": 2, "sensor": [36, 24], "filter": ["tent", 2]; the four corners of a
// quadrilateral are four arrays. What a row refers to is named by a text.
#pragma once

#include "desc/names.h"
#include "desc/properties.h"
#include "read/json/fields.h"
#include "read/json/names.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

// The values of one key in the order of the row.
class JsonPropertyValues {
public:
    // `count` values are wanted; corners stand in arrays of three.
    JsonPropertyValues(const JsonValue& value, std::string_view key, std::size_t count,
                       bool inTriples, JsonProblems& problems);
    bool hasAll() const { return values_.size() == count_; }

    template <class Number> void readNumber(Number& out, const Range& range) {
        readJsonValue(*values_[next_++], key_, problems_, out, range);
    }
    // The position of the word in `names`, or nothing after an error.
    std::optional<std::size_t> readWord(std::span<const std::string_view> names);

private:
    std::string_view key_;
    std::size_t count_, next_ = 0;
    JsonProblems& problems_;
    std::vector<const JsonValue*> values_;
};

template <class Block>
void readJsonProperty(const JsonValue& value, const Property<Block>& row, const JsonNames& textures,
                      JsonProblems& problems, Block& block) {
    if (const auto* flag = std::get_if<bool Block::*>(&row.first)) {
        readJsonValue(value, row.keyword, problems, block.**flag);
        return;
    }
    if (const auto* text = std::get_if<std::string Block::*>(&row.first)) {
        readJsonValue(value, row.keyword, problems, block.**text);
        return;
    }
    if (const auto* reference = std::get_if<Reference<Block>>(&row.first)) {
        std::string name;
        if (!readJsonValue(value, row.keyword, problems, name)) return;
        block.*(reference->handle) = textures.find(name);
        if (block.*(reference->handle) == kNone)
            problems.error(value.loc(), [&] {
                return cat("unknown texture ", unknownName(shown(name), textures.known()));
            });
        return;
    }
    const auto* choice = std::get_if<Choice<Block>>(&row.first);
    auto* crop = std::get_if<Crop Block::*>(&row.first);
    if (crop) (block.**crop).emplace();
    std::size_t count = choice ? 1 : 0;
    const auto countOne = [&](auto&) { ++count; };
    forEachNumber(block, row.first, countOne);
    if (row.second) forEachNumber(block, *row.second, countOne);
    JsonPropertyValues values(value, row.keyword, count,
                              std::holds_alternative<SeldomCorners Block::*>(row.first), problems);
    if (!values.hasAll()) return;
    if (choice)
        if (const auto position = values.readWord(choice->names)) choice->set(block, *position);
    const auto readOne = [&](auto& number) { values.readNumber(number, row.range); };
    forEachNumber(block, row.first, readOne);
    if (row.second) forEachNumber(block, *row.second, readOne);
}

// All rows that exist for this kind of block, but those that the caller reads in a way of its own.
// Lights have all rows: validate() warns of those without effect.
template <class Block>
void readJsonProperties(JsonFields& fields, const JsonNames& textures, Block& block,
                        std::initializer_list<std::string_view> except = {}) {
    for (const Property<Block>& row : propertiesOf<Block>()) {
        if (std::find(except.begin(), except.end(), row.keyword) != except.end()) continue;
        if (std::is_same_v<Block, ObjectDesc> && !(row.kinds & kindOf(block))) continue;
        if (const JsonValue* value = fields.take(row.keyword))
            readJsonProperty(*value, row, textures, fields.problems(), block);
    }
}
