#include "read/json/fields.h"

#include "base/text.h"
#include "desc/names.h"

#include <algorithm>
#include <cmath>

namespace {

bool failType(const JsonValue& value, std::string_view key, std::string_view expected,
              JsonProblems& problems) {
    problems.error(value.loc(), [&] {
        return cat("expected ", expected, " for '", key, "', got ", described(value));
    });
    return false;
}

// The numbers of an array, all of them right or none is taken.
bool readTriple(const JsonValue& value, std::string_view key, JsonProblems& problems, Vec3d& out,
                const Range& range) {
    const auto items = value.items();
    if (!value.isArray()) return failType(value, key, "an array of 3 numbers", problems);
    if (items.size() != 3) {
        problems.error(value.loc(), [&] {
            return cat("expected an array of 3 numbers for '", key, "', got ", items.size());
        });
        return false;
    }
    Vec3d read;
    for (std::size_t i = 0; i < 3; ++i)
        if (!readJsonValue(items[i], key, problems, read[i], range)) return false;
    out = read;
    return true;
}

} // namespace

bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems,
                   bool& out) {
    if (value.kind() != JsonValue::Kind::Bool)
        return failType(value, key, "true or false", problems);
    out = value.boolean();
    return true;
}

bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems,
                   std::string& out) {
    if (!value.isString()) return failType(value, key, "a text", problems);
    out = value.text();
    return true;
}

bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems,
                   double& out, const Range& range) {
    if (value.isString() && value.text() == "inf" && range.contains(kEndless)) {
        out = kEndless; // JSON has no number for it
        return true;
    }
    if (!value.isNumber()) return failType(value, key, "a number", problems);
    if (!range.contains(value.number())) {
        problems.error(value.loc(), [&] {
            return cat("'", key, "' ", mustBe(range, value.number()), ", got ",
                       shortest(value.number()));
        });
        return false;
    }
    out = value.number();
    return true;
}

bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems, int& out,
                   const Range& range) {
    double whole = 0;
    if (!readJsonWhole(value, key, problems, whole, range)) return false;
    out = static_cast<int>(whole);
    return true;
}

bool readJsonWhole(const JsonValue& value, std::string_view key, JsonProblems& problems,
                   double& out, const Range& range) {
    const double number = value.number();
    if (!value.isNumber() || number != std::floor(number) || !range.contains(number))
        return failType(value, key,
                        cat("a whole number from ", shortest(range.lo), " to ",
                            static_cast<long long>(range.hi)),
                        problems);
    out = number;
    return true;
}

bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems, Vec3d& out,
                   const Range& range) {
    return readTriple(value, key, problems, out, range);
}

bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems, Rgbd& out,
                   const Range& range) {
    Vec3d rgb;
    if (!readTriple(value, key, problems, rgb, range)) return false;
    out = {rgb.x, rgb.y, rgb.z};
    return true;
}

JsonFields::JsonFields(const JsonValue& value, std::string what, JsonProblems& problems)
    : members_(value.members()), loc_(value.loc()), what_(std::move(what)), problems_(problems),
      known_(members_.size()) {
    if (!value.isObject())
        problems_.error(value.loc(), [&] {
            return cat("expected an object for ", what_, ", got ", described(value));
        });
    constexpr std::size_t kUsual = 24;
    asked_.reserve(kUsual);
    take("comment");
}

const JsonValue* JsonFields::take(std::string_view key) {
    asked_.push_back(key);
    for (std::size_t i = 0; i < members_.size(); ++i) {
        if (members_[i].key != key) continue;
        known_[i] = true;
        return members_[i].value.isNull() ? nullptr : &members_[i].value;
    }
    return nullptr;
}

const JsonValue* JsonFields::find(std::string_view key) const {
    for (const JsonMember& member : members_)
        if (member.key == key && !member.value.isNull()) return &member.value;
    return nullptr;
}

JsonFields::Taken JsonFields::takeOneOf(std::initializer_list<std::string_view> keys) {
    Taken first;
    for (const std::string_view key : keys) {
        const JsonValue* value = take(key);
        if (!value) continue;
        if (first.value)
            problems_.error(value->loc(), [&] {
                return cat(what_, ": give '", first.key, "' or '", key, "', not both");
            });
        else
            first = {key, value};
    }
    return first;
}

std::span<const JsonValue> JsonFields::list(std::string_view key) {
    const JsonValue* value = take(key);
    if (value && !value->isArray()) failType(*value, key, "an array", problems_);
    return value ? value->items() : std::span<const JsonValue>();
}

void JsonFields::reportUnknown() const {
    for (std::size_t i = 0; i < members_.size(); ++i) {
        if (known_[i]) continue;
        problems_.error(members_[i].loc, [&] {
            std::vector<std::string> known(asked_.begin(), asked_.end());
            // As they stand in the file, one after the other; "comment" was asked for first.
            std::rotate(known.begin(), known.begin() + 1, known.end());
            const std::string name = shown(members_[i].key);
            return cat("unknown key '", name, "' of ", what_,
                       unknownName(name, known).substr(name.size() + 2));
        });
    }
}
