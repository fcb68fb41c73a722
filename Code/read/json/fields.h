// An object of a scene in JSON while it is read: each key is asked for by name and type, and what
// nobody has asked for is unknown. Knows no key but "comment", which every object may have.
#pragma once

#include "base/text.h"
#include "base/vec.h"
#include "desc/validate.h"
#include "desc/range.h"
#include "desc/scene_desc.h"
#include "read/json/json.h"
#include "read/read_context.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// What is wrong with a scene in JSON: errors are collected and thrown together, and of the warnings
// so many are shown as somebody will read.
class JsonProblems {
public:
    JsonProblems(const SourceFile& source, const ReadContext& context)
        : source_(source), context_(context), errors_(source) {}

    // The text is made only when it will be shown. Under --lenient this is a warning: readers go on
    // with what they have then, a default or nothing.
    template <class MakeText> void error(SourceLoc loc, MakeText&& makeText) {
        if (context_.options.lenient)
            warn(loc, makeText);
        else
            errors_.add(loc, makeText);
    }
    // Fails for what nothing can be made of, because memory would not suffice.
    template <class MakeText> void fatal(SourceLoc loc, MakeText&& makeText) {
        errors_.add(loc, makeText);
    }
    template <class MakeText> void warn(SourceLoc loc, MakeText&& makeText) {
        if (++warningCount_ <= kShownWarnings) context_.warn(source_, loc.offset, makeText());
    }

    bool isLenient() const { return context_.options.lenient; }
    bool hasErrors() const { return errors_.count() > 0; }
    void finish() const {
        if (warningCount_ > kShownWarnings)
            context_.diagnostics.warnings.push_back(cat(
                source_.name, ": warning: and ", warningCount_ - kShownWarnings, " more warnings"));
        errors_.throwIfAny();
    }

private:
    static constexpr std::size_t kShownWarnings = 100;

    const SourceFile& source_;
    const ReadContext& context_;
    ErrorList errors_;
    std::size_t warningCount_ = 0;
};

// The value for `key` as one of the types that scenes have. What does not fit is noted as an error
// and leaves `out` as it is.
bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems, bool& out);
bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems,
                   std::string& out);
bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems,
                   double& out, const Range& range);
bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems, int& out,
                   const Range& range);
bool readJsonWhole(const JsonValue& value, std::string_view key, JsonProblems& problems,
                   double& out, const Range& range);
bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems, Vec3d& out,
                   const Range& range);
bool readJsonValue(const JsonValue& value, std::string_view key, JsonProblems& problems, Rgbd& out,
                   const Range& range);

class JsonFields {
public:
    // `what` is for messages: "the camera", "the sphere 'ball'". A value that is no object is an
    // error, and then has no keys.
    JsonFields(const JsonValue& value, std::string what, JsonProblems& problems);

    const std::string& what() const { return what_; }
    SourceLoc loc() const { return loc_; }
    JsonProblems& problems() const { return problems_; }

    // Null is as good as nothing: then, and when the key is not there, nullptr. The key must live
    // as long as this object.
    const JsonValue* take(std::string_view key);
    // The value without taking it.
    const JsonValue* find(std::string_view key) const;
    bool has(std::string_view key) const { return find(key) != nullptr; }
    // take() for keys that mean the same, or exclude each other: two at once are an error.
    struct Taken {
        std::string_view key;
        const JsonValue* value = nullptr;
    };
    Taken takeOneOf(std::initializer_list<std::string_view> keys);

    // Is the key there (as something, not null)? out keeps its value when it is not, or is wrong.
    template <class T, class... RangeOrNothing>
    const JsonValue* read(std::string_view key, T& out, const RangeOrNothing&... range) {
        const JsonValue* value = take(key);
        if (value) readJsonValue(*value, key, problems_, out, range...);
        return value;
    }
    // The items of an array; none when the key is not there.
    std::span<const JsonValue> list(std::string_view key);

    // After the last question.
    void reportUnknown() const;

private:
    std::span<const JsonMember> members_;
    SourceLoc loc_;
    std::string what_;
    JsonProblems& problems_;
    std::vector<bool> known_; // by member
    std::vector<std::string_view> asked_;
};
