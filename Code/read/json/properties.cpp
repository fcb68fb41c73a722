#include "read/json/properties.h"

#include "base/text.h"
#include "desc/names.h"

#include <algorithm>
#include <vector>

namespace {

// The values for a key in the order of the row; corners stand in arrays of three. None after an
// error: so many are wanted.
std::vector<const JsonValue*> valuesOf(const JsonValue& value, const Property& row,
                                       std::size_t count, JsonProblems& problems) {
    const bool inTriples = row.first.kind == FieldKind::Corners;
    std::vector<const JsonValue*> values;
    if (count == 1)
        values.push_back(&value);
    else if (!inTriples)
        for (const JsonValue& item : value.items()) values.push_back(&item);
    else
        for (const JsonValue& triple : value.items())
            if (triple.items().size() == 3)
                for (const JsonValue& item : triple.items()) values.push_back(&item);
    if (values.size() == count) return values;
    problems.error(value.loc(), [&] {
        const std::string expected = inTriples ? cat(count / 3, " arrays of 3 numbers")
                                               : cat("an array of ", count, " values");
        return cat("expected ", expected, " for '", row.keyword, "', got ",
                   value.isArray() ? cat("an array of ", value.items().size()) : described(value));
    });
    return {};
}

void readChoice(const JsonValue& value, const Property& row, JsonProblems& problems, void* block) {
    std::string word;
    if (!readJsonValue(value, row.keyword, problems, word)) return;
    const auto names = row.first.names;
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end())
        return problems.error(value.loc(),
                              [&] { return unknownValue(row.keyword, shown(word), names); });
    at<std::uint8_t>(row.first, block) = static_cast<std::uint8_t>(found - names.begin());
}

// Reads a colour that is written as one number, a grey, or as true, which is 1, and false. Returns
// false where it is written in another way.
bool readGrey(const JsonValue& value, const Property& row, JsonProblems& problems, void* block) {
    const bool isFlag = value.kind() == JsonValue::Kind::Bool;
    if (row.first.kind != FieldKind::Color || !(isFlag || value.isNumber())) return false;
    double grey = value.boolean() ? 1 : 0;
    if (isFlag || readJsonValue(value, row.keyword, problems, grey, row.range)) {
        const std::array<double, 3> numbers{grey, grey, grey};
        setNumbers(row, block, numbers.data());
    }
    return true;
}

// Of a row with numbers, perhaps behind a choice.
void readValues(const JsonValue& value, const Property& row, JsonProblems& problems, void* block) {
    const bool isChoice = row.first.kind == FieldKind::Choice;
    const auto values = valuesOf(value, row, row.numberCount() + (isChoice ? 1 : 0), problems);
    if (values.empty()) return;
    if (isChoice) readChoice(*values[0], row, problems, block);
    std::array<double, kMostNumbers> numbers{};
    getNumbers(row, block, numbers.data());
    double* next = numbers.data();
    for (const JsonValue* number : std::span(values).subspan(isChoice ? 1 : 0))
        if (row.isWhole())
            readJsonWhole(*number, row.keyword, problems, *next++, row.range);
        else
            readJsonValue(*number, row.keyword, problems, *next++, row.range);
    setNumbers(row, block, numbers.data());
}

} // namespace

Handle readJsonTexture(const JsonValue& value, std::string_view key, const JsonNames& textures,
                       JsonProblems& problems) {
    std::string name;
    if (!readJsonValue(value, key, problems, name)) return kNone;
    const Handle handle = textures.find(name);
    if (handle == kNone)
        problems.error(value.loc(), [&] {
            return cat("unknown texture ", unknownName(shown(name), textures.known()));
        });
    return handle;
}

void readJsonProperty(const JsonValue& value, const Property& row, const JsonNames& textures,
                      JsonProblems& problems, void* block) {
    const Field& field = row.first;
    switch (field.kind) {
    case FieldKind::Flag:
        readJsonValue(value, row.keyword, problems, at<bool>(field, block));
        return;
    case FieldKind::Text:
        readJsonValue(value, row.keyword, problems, at<std::string>(field, block));
        return;
    case FieldKind::Name:
        at<Handle>(field, block) = readJsonTexture(value, row.keyword, textures, problems);
        return;
    default:
        if (!readGrey(value, row, problems, block)) readValues(value, row, problems, block);
    }
}

void readJsonProperties(JsonFields& fields, const JsonNames& textures, BlockType type,
                        KindMask kinds, void* block,
                        std::initializer_list<std::string_view> except) {
    for (const Property& row : propertiesOf(type)) {
        if (std::find(except.begin(), except.end(), row.keyword) != except.end()) continue;
        if (!(row.kinds & kinds)) continue;
        if (const JsonValue* value = fields.take(row.keyword))
            readJsonProperty(*value, row, textures, fields.problems(), block);
    }
}
