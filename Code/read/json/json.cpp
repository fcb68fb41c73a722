#include "read/json/json.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/json/tokens.h"
#include "read/read_context.h"

#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace {

class Parser {
public:
    Parser(const SourceFile& source, JsonGrammar grammar)
        : source_(source), grammar_(grammar), p_(source.text.data()), end_(p_ + source.text.size()),
          memory_(std::make_unique<std::pmr::monotonic_buffer_resource>()) {}

    JsonDocument parse() {
        // Editors on Windows write a byte order mark, which readers may ignore (RFC 8259, 8.1).
        if (source_.text.starts_with("\xef\xbb\xbf")) p_ += 3;
        skipBlanks();
        if (p_ == end_) fail(p_, "the file is empty; expected a JSON value");
        const JsonValue root = value(0);
        skipBlanks();
        if (p_ != end_) fail(p_, cat("expected the end of the file, got ", hereText()));
        return {std::move(memory_), root, std::move(liberties_)};
    }

    bool tookLiberties() const { return !liberties_.empty(); }

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
        if (grammar_ == JsonGrammar::Standard) return;
        if (*p_ == '/' && (p_[1] == '/' || p_[1] == '*')) isJson5(p_, "a comment");
        const char* next = skipJson5Blanks(source_, p_);
        if (next != p_) isJson5(p_, "a blank of this kind");
        p_ = next;
    }

    // Notes the first liberty of JSON5. False when that is not read.
    bool isJson5(const char* at, std::string_view what) {
        if (grammar_ == JsonGrammar::Standard) return false;
        if (!tookLiberty_)
            liberties_.push_back(
                {locOf(at), cat(what, " is JSON5, which other programs may not read as JSON")});
        tookLiberty_ = true;
        return true;
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
            if (grammar_ != JsonGrammar::Standard && beginsJson5Number(p_)) return json5Number();
            if (*p_ == '-' || isJsonDigit(*p_)) return number();
            if (*p_ == '\'' && isJson5(p_, "a text in single quotes")) {
                const std::string_view text = string();
                return {locOf(start), text};
            }
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

    JsonValue json5Number() {
        const char* start = p_;
        JsonNumber read;
        read.end = readPlainNumber(start, end_, read.value);
        if (!read.end || isJsonLetter(*read.end) || *read.end == '.')
            read = readJson5Number(source_, start);
        p_ = read.end;
        const std::string_view written(start, static_cast<std::size_t>(read.end - start));
        const std::size_t point = written.find('.');
        const auto isDigitAt = [&](std::size_t i) {
            return i < written.size() && isJsonDigit(written[i]);
        };
        const bool hasBarePoint =
            point < written.size() && !(point > 0 && isDigitAt(point - 1) && isDigitAt(point + 1));
        if (hasBarePoint || *start == '+' || written.find_first_of("xX") < written.size())
            isJson5(start, cat("the number ", shown(written)));
        return {locOf(start), read.value};
    }

    // Most texts stand in the file as they are; those with escapes are decoded into the arena.
    std::string_view string() {
        if (grammar_ != JsonGrammar::Standard) return json5String();
        const JsonText text = readJsonText(source_, p_);
        p_ = text.end;
        if (!text.hasEscapes)
            return {text.begin, static_cast<std::size_t>(text.end - 1 - text.begin)};
        decoded_.clear();
        decodeJsonText(source_, text, decoded_);
        return keptText();
    }
    std::string_view json5String() {
        const char* start = p_;
        decoded_.clear();
        p_ = readJson5Text(source_, start, decoded_);
        for (const char* p = start; p < p_; ++p)
            if (*p == '\\' && std::string_view("\"\\/bfnrtu").find(*++p) == std::string_view::npos)
                isJson5(p - 1, "an escape of this kind");
        return keptText();
    }
    std::string_view keptText() {
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
        if (*p_ != close) return true;
        if (!isJson5(comma, cat("a ',' before '", close, "'")))
            fail(comma, cat("a ',' before '", close, "'; the last item has none after it"));
        ++p_;
        return false;
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
        checkUnique(std::span<const JsonMember>(members_).subspan(base));
        if (hasTwice_) keepLast(base);
        const auto members = kept(std::span<const JsonMember>(members_).subspan(base));
        members_.resize(base);
        return {locOf(start), members};
    }

    JsonMember member(int depth) {
        const char* start = p_;
        const std::string_view key = this->key();
        skipBlanks();
        if (*p_ != ':')
            fail(p_, cat("expected ':' after the key '", shown(key), "', got ", hereText()));
        ++p_;
        skipBlanks();
        return {key, locOf(start), value(depth)};
    }

    std::string_view key() {
        const char* start = p_;
        if (*p_ == '"' || (*p_ == '\'' && isJson5(start, "a key in single quotes")))
            return string();
        if (const char* end = endOfJson5Key(p_);
            end != p_ && isJson5(start, "a key without quotes")) {
            p_ = end;
            return {start, static_cast<std::size_t>(end - start)};
        }
        fail(p_, cat("expected a key in double quotes", p_ == end_ ? " before " : ", got ",
                     hereText()));
    }

    void checkUnique(std::span<const JsonMember> members) {
        constexpr std::size_t kFew = 16; // where comparing all pairs beats a table
        if (members.size() <= kFew) {
            for (std::size_t i = 1; i < members.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    if (members[i].key == members[j].key) isTwice(members[j], members[i]);
            return;
        }
        std::unordered_map<std::string_view, const JsonMember*> seen;
        for (const JsonMember& member : members) {
            const auto [first, isNew] = seen.try_emplace(member.key, &member);
            if (!isNew) isTwice(*first->second, member);
        }
    }
    void isTwice(const JsonMember& first, const JsonMember& again) {
        const std::string what = cat("the key '", shown(again.key), "' was given already at line ",
                                     lineOf(source_, first.loc.offset));
        if (grammar_ != JsonGrammar::Lenient)
            failAt(source_, again.loc.offset, cat(what, "; an object has each key once"));
        liberties_.push_back({again.loc, cat(what, "; this one holds")});
        hasTwice_ = true;
    }
    // Keeps only the last of the members from `base` on that have the same key.
    void keepLast(std::size_t base) {
        std::unordered_set<std::string_view> seen;
        std::size_t out = members_.size();
        for (std::size_t i = members_.size(); i > base; --i)
            if (seen.insert(members_[i - 1].key).second) members_[--out] = members_[i - 1];
        members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(base),
                       members_.begin() + static_cast<std::ptrdiff_t>(out));
        hasTwice_ = false;
    }

    const SourceFile& source_;
    const JsonGrammar grammar_;
    const char* p_;
    const char* end_; // *end_ is the string's terminating zero
    std::unique_ptr<std::pmr::monotonic_buffer_resource> memory_;
    // What is read of the lists that are still open, innermost last.
    std::vector<JsonValue> items_;
    std::vector<JsonMember> members_;
    std::string decoded_;
    std::vector<JsonLiberty> liberties_;
    bool tookLiberty_ = false; // of JSON5
    bool hasTwice_ = false;    // does the object that ends have a key twice?
};

} // namespace

JsonDocument parseJson(const SourceFile& source, JsonGrammar grammar) {
    checkTextSize(source);
    if (grammar != JsonGrammar::Standard) {
        Parser parser(source, grammar);
        try {
            return parser.parse();
        } catch (const Error&) {
            if (parser.tookLiberties()) throw;
        }
    }
    return Parser(source, JsonGrammar::Standard).parse(); // of JSON it says best what is wrong
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
