#include "read/json/properties.h"

#include "base/enum_names.h"
#include "base/text.h"

#include <algorithm>
#include <optional>

JsonPropertyValues::JsonPropertyValues(const JsonValue& value, std::string_view key,
                                       std::size_t count, bool inTriples, JsonProblems& problems)
    : key_(key), count_(count), problems_(problems) {
    if (count == 1)
        values_.push_back(&value);
    else if (!inTriples)
        for (const JsonValue& item : value.items()) values_.push_back(&item);
    else
        for (const JsonValue& triple : value.items())
            if (triple.items().size() == 3)
                for (const JsonValue& item : triple.items()) values_.push_back(&item);
    if (!hasAll())
        problems_.error(value.loc(), [&] {
            const std::string expected = inTriples ? cat(count / 3, " arrays of 3 numbers")
                                                   : cat("an array of ", count, " values");
            return cat("expected ", expected, " for '", key, "', got ",
                       value.isArray() ? cat("an array of ", value.items().size())
                                       : described(value));
        });
}

std::optional<std::size_t> JsonPropertyValues::readWord(std::span<const std::string_view> names) {
    const JsonValue& value = *values_[next_++];
    std::string word;
    if (!readJsonValue(value, key_, problems_, word)) return {};
    const auto found = std::find(names.begin(), names.end(), word);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    problems_.error(value.loc(), [&] { return unknownValue(key_, shown(word), names); });
    return {};
}
