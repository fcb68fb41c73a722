#include "read/json/json.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/json/tokens.h"
#include "read/read_context.h"

#include <unordered_map>
#include <vector>

namespace {

class Parser {
public:
    explicit Parser(const SourceFile& source)
        : source_(source), p_(source.text.data()), end_(p_ + source.text.size()),
          memory_(std::make_unique<std::pmr::monotonic_buffer_resource>()) {}

    JsonDocument parse() {
        // Editors on Windows write a byte order mark, which readers may ignore (RFC 8259, 8.1).
        if (source_.text.starts_with("\xef\xbb\xbf")) p_ += 3;
        skipBlanks();
        if (p_ == end_) fail(p_, "the file is empty; expected a JSON value");
        const JsonValue root = value(0);
        skipBlanks();
        if (p_ != end_) fail(p_, cat("expected the end of the file, got ", hereText()));
        return {std::move(memory_), root};
    }

private:
    [[noreturn]] void fail(const char* at, std::string_view what) const {
        failAt(source_, static_cast<std::size_t>(at - source_.text.data()), what);
    }
    SourceLoc locOf(const char* at) const {
        return {static_cast<std::uint32_t>(at - source_.text.data())};
    }
    std::string hereText() const { return jsonHere(source_, p_); }
    // The text ends in the zero of std::string, which is no blank and starts no value.
    void skipBlanks() {
        while (*p_ == ' ' || *p_ == '\n' || *p_ == '\r' || *p_ == '\t') ++p_;
    }

    // In the arena, where it stays as long as the document.
    template <class T> std::span<const T> kept(std::span<const T> values) {
        if (values.empty()) return {};
        auto* copy = static_cast<T*>(memory_->allocate(values.size_bytes(), alignof(T)));
        std::uninitialized_copy(values.begin(), values.end(), copy);
        return {copy, values.size()};
    }

    JsonValue value(int depth) {
        const char* start = p_;
        switch (*p_) {
        case '{': return object(depth + 1);
        case '[': return array(depth + 1);
        case '"': {
            const std::string_view text = string();
            return {locOf(start), text};
        }
        case 't': return word("true", {locOf(start), true});
        case 'f': return word("false", {locOf(start), false});
        case 'n': return word("null", JsonValue(locOf(start)));
        default:
            if (*p_ == '-' || isJsonDigit(*p_)) return number();
            failNoJsonValue(source_, p_);
        }
    }
    JsonValue word(std::string_view expected, JsonValue value) {
        p_ = endOfJsonWord(source_, p_, expected);
        return value;
    }
    JsonValue number() {
        const char* start = p_;
        const JsonNumber read = readJsonNumber(source_, start);
        p_ = read.end;
        return {locOf(start), read.value};
    }

    // Most texts stand in the file as they are; those with escapes are decoded into the arena.
    std::string_view string() {
        const JsonText text = readJsonText(source_, p_);
        p_ = text.end;
        if (!text.hasEscapes)
            return {text.begin, static_cast<std::size_t>(text.end - 1 - text.begin)};
        decoded_.clear();
        decodeJsonText(source_, text, decoded_);
        const std::span<const char> copy = kept(std::span<const char>(decoded_));
        return {copy.data(), copy.size()};
    }

    void enter(int depth) const {
        if (depth > kDeepestJson)
            fail(p_, cat("arrays and objects are nested more than ", kDeepestJson, " deep"));
    }

    // After an item: true when another one follows. `opened` is where the list begins.
    bool another(char close, const char* opened, std::string_view after) {
        skipBlanks();
        if (*p_ == close) {
            ++p_;
            return false;
        }
        if (*p_ != ',' && p_ == end_)
            fail(p_, cat("expected ',' or '", close, "' before the end of the file; '", *opened,
                         "' was opened at line ", lineOf(source_, locOf(opened).offset)));
        if (*p_ != ',')
            fail(p_, cat("expected ',' or '", close, "' after ", after, ", got ", hereText()));
        const char* comma = p_++;
        skipBlanks();
        if (*p_ == close)
            fail(comma, cat("a ',' before '", close, "'; the last item has none after it"));
        return true;
    }

    JsonValue array(int depth) {
        enter(depth);
        const char* start = p_++;
        const std::size_t base = items_.size();
        skipBlanks();
        if (*p_ == ']')
            ++p_;
        else
            do items_.push_back(value(depth));
            while (another(']', start, "an item of an array"));
        const auto items = kept(std::span<const JsonValue>(items_).subspan(base));
        items_.resize(base);
        return {locOf(start), items};
    }

    JsonValue object(int depth) {
        enter(depth);
        const char* start = p_++;
        const std::size_t base = members_.size();
        skipBlanks();
        if (*p_ == '}')
            ++p_;
        else
            do members_.push_back(member(depth));
            while (another('}', start, "a value of an object"));
        const auto members = kept(std::span<const JsonMember>(members_).subspan(base));
        members_.resize(base);
        checkUnique(members);
        return {locOf(start), members};
    }

    JsonMember member(int depth) {
        const char* start = p_;
        if (*p_ != '"')
            fail(p_, cat("expected a key in double quotes", p_ == end_ ? " before " : ", got ",
                         hereText()));
        const std::string_view key = string();
        skipBlanks();
        if (*p_ != ':')
            fail(p_, cat("expected ':' after the key '", shown(key), "', got ", hereText()));
        ++p_;
        skipBlanks();
        return {key, locOf(start), value(depth)};
    }

    void checkUnique(std::span<const JsonMember> members) const {
        constexpr std::size_t kFew = 16; // where comparing all pairs beats a table
        if (members.size() <= kFew) {
            for (std::size_t i = 1; i < members.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    if (members[i].key == members[j].key) failTwice(members[j], members[i]);
            return;
        }
        std::unordered_map<std::string_view, const JsonMember*> seen;
        for (const JsonMember& member : members) {
            const auto [first, isNew] = seen.try_emplace(member.key, &member);
            if (!isNew) failTwice(*first->second, member);
        }
    }
    [[noreturn]] void failTwice(const JsonMember& first, const JsonMember& again) const {
        failAt(source_, again.loc.offset,
               cat("the key '", shown(again.key), "' was given already at line ",
                   lineOf(source_, first.loc.offset), "; an object has each key once"));
    }

    const SourceFile& source_;
    const char* p_;
    const char* end_; // *end_ is the string's terminating zero
    std::unique_ptr<std::pmr::monotonic_buffer_resource> memory_;
    // What is read of the lists that are still open, innermost last.
    std::vector<JsonValue> items_;
    std::vector<JsonMember> members_;
    std::string decoded_;
};

} // namespace

JsonDocument parseJson(const SourceFile& source) {
    checkTextSize(source);
    return Parser(source).parse();
}

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
