#include "read/mesh/ply_header.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/number.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace {

struct Word {
    std::size_t offset = 0;
    std::string_view text;
};

struct TypeName {
    std::string_view name;
    PlyType type;
};
// The names of 1994 and those that say their size.
constexpr auto kTypeNames = std::to_array<TypeName>({
    {"char", PlyType::Int8},
    {"uchar", PlyType::Uint8},
    {"short", PlyType::Int16},
    {"ushort", PlyType::Uint16},
    {"int", PlyType::Int32},
    {"uint", PlyType::Uint32},
    {"float", PlyType::Float32},
    {"double", PlyType::Float64},
    {"int8", PlyType::Int8},
    {"uint8", PlyType::Uint8},
    {"int16", PlyType::Int16},
    {"uint16", PlyType::Uint16},
    {"int32", PlyType::Int32},
    {"uint32", PlyType::Uint32},
    {"float32", PlyType::Float32},
    {"float64", PlyType::Float64},
});

template <class Rows> const auto* named(const Rows& rows, std::string_view name) {
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == name; });
    return row == rows.end() ? nullptr : &*row;
}

template <class Rows> std::vector<std::string> namesOf(const Rows& rows) {
    std::vector<std::string> names;
    for (const auto& row : rows) names.emplace_back(row.name);
    return names;
}

class HeaderReader {
public:
    explicit HeaderReader(const SourceFile& source) : source_(source) {}

    PlyHeader read() {
        nextLine();
        if (words_.size() != 1 || words_[0].text != "ply")
            fail(0, "expected 'ply' as the first line of a PLY file");
        while (true) {
            if (next_ >= source_.text.size())
                fail(next_, "the header does not end; expected 'end_header'");
            nextLine();
            if (words_.empty()) continue;
            if (words_[0].text == "end_header") break;
            readLine();
        }
        if (!hasFormat_)
            fail(words_[0].offset, "the header has no line 'format', such as 'format ascii 1.0'");
        header_.dataOffset = next_;
        return std::move(header_);
    }

private:
    struct Keyword {
        std::string_view name;
        void (HeaderReader::*read)();
    };

    [[noreturn]] void fail(std::size_t offset, std::string_view what) const {
        failAt(source_, offset, what);
    }

    // A line ends in \n or \r\n. Only the first words of a long one count: binary data without a
    // header can be one line of gigabytes.
    void nextLine() {
        const std::string_view text = source_.text;
        const std::size_t start = next_, newline = text.find('\n', start);
        const std::size_t end = std::min(newline, text.size());
        next_ = newline == std::string_view::npos ? text.size() : newline + 1;
        constexpr std::size_t kMostWords = 8;
        words_.clear();
        for (std::size_t i = start; words_.size() < kMostWords;) {
            i = std::min(text.find_first_not_of(" \t\r", i), end);
            if (i == end) break;
            const std::size_t wordEnd = std::min(text.find_first_of(" \t\r\n", i), end);
            words_.push_back({i, text.substr(i, wordEnd - i)});
            i = wordEnd;
        }
        lineEnd_ = end;
    }

    void readLine() {
        static constexpr auto kKeywords = std::to_array<Keyword>({
            {"format", &HeaderReader::readFormat},
            {"comment", &HeaderReader::readComment},
            {"obj_info", &HeaderReader::skipLine},
            {"element", &HeaderReader::readElement},
            {"property", &HeaderReader::readProperty},
            {"end_header", &HeaderReader::skipLine},
        });
        const Word& first = words_[0];
        if (const Keyword* keyword = named(kKeywords, first.text)) return (this->*keyword->read)();
        fail(first.offset, cat("unknown line in the header: ",
                               unknownName(shown(first.text), namesOf(kKeywords))));
    }

    void skipLine() {}
    void readComment() {
        if (words_.size() > 2 && words_[1].text == "TextureFile")
            header_.pictures.push_back(words_.back().text);
    }

    void expectWords(std::size_t count, std::string_view form) const {
        if (words_.size() == count) return;
        fail(words_.size() < count ? lineEnd_ : words_[count].offset,
             cat("expected '", form, "'", words_.size() < count ? "" : " and no more"));
    }

    void readFormat() {
        expectWords(3, "format NAME 1.0");
        if (hasFormat_) fail(words_[0].offset, "'format' was given already");
        hasFormat_ = true;
        const auto format = valueNamed<PlyFormat>(words_[1].text);
        if (!format)
            fail(words_[1].offset, unknownValue<PlyFormat>("format", shown(words_[1].text)));
        header_.format = *format;
        if (words_[2].text != "1.0")
            fail(words_[2].offset, cat("the file has version '", shown(words_[2].text),
                                       "' of the format; this program reads version 1.0"));
    }

    void readElement() {
        expectWords(3, "element NAME COUNT");
        const Word &name = words_[1], &number = words_[2];
        if (!names_.insert({0, name.text}).second)
            fail(name.offset, cat("another element has the name '", shown(name.text), "' already"));
        const auto count = readUnsigned(number.text.data());
        if (count.fault == NumberFault::TooLarge)
            fail(number.offset, cat("the count '", shown(number.text), "' is too large"));
        if (count.fault != NumberFault::None ||
            count.end != number.text.data() + number.text.size())
            fail(number.offset, cat("expected a count, got '", shown(number.text), "'"));
        header_.elements.push_back({name.text, words_[0].offset, count.value, {}});
    }

    void readProperty() {
        if (header_.elements.empty())
            fail(words_[0].offset, "a property needs a line 'element' before it");
        PlyProperty property;
        property.offset = words_[0].offset;
        if (words_.size() > 1 && words_[1].text == "list") {
            expectWords(5, "property list COUNT_TYPE TYPE NAME");
            property.countType = typeNamed(words_[2]);
            if (!isWhole(*property.countType))
                fail(words_[2].offset, "the count of a list must have a whole type, such as uchar");
            property.type = typeNamed(words_[3]);
        } else {
            expectWords(3, "property TYPE NAME");
            property.type = typeNamed(words_[1]);
        }
        property.name = words_.back().text;
        PlyElement& element = header_.elements.back();
        if (!names_.insert({header_.elements.size(), property.name}).second)
            fail(words_.back().offset,
                 cat("element '", shown(element.name), "' has a property of this name already"));
        element.properties.push_back(property);
    }

    PlyType typeNamed(const Word& word) const {
        if (const TypeName* row = named(kTypeNames, word.text)) return row->type;
        fail(word.offset, cat("unknown type ", unknownName(shown(word.text), namesOf(kTypeNames))));
    }

    const SourceFile& source_;
    PlyHeader header_;
    bool hasFormat_ = false;
    std::vector<Word> words_; // of the line
    std::size_t lineEnd_ = 0, next_ = 0;
    // Of the properties by element, which count from 1; 0 for the names of the elements.
    std::set<std::pair<std::size_t, std::string_view>> names_;
};

// Groups of properties that count only together, in the order of preference: of several names for
// the same the first ones.
struct Group {
    PlyRole first;
    std::array<std::string_view, 3> names; // the last one may be empty
};
constexpr auto kGroups = std::to_array<Group>({
    {PlyRole::X, {"x", "y", "z"}},
    {PlyRole::NormalX, {"nx", "ny", "nz"}},
    {PlyRole::U, {"s", "t"}},
    {PlyRole::U, {"u", "v"}},
    {PlyRole::U, {"texture_u", "texture_v"}},
    {PlyRole::U, {"texture_s", "texture_t"}},
});

} // namespace

const PlyProperty* PlyElement::property(std::string_view wanted) const {
    return named(properties, wanted);
}
const PlyElement* PlyHeader::element(std::string_view wanted) const {
    return named(elements, wanted);
}

PlyHeader readPlyHeader(const SourceFile& source) { return HeaderReader(source).read(); }

VertexRoles rolesOf(const PlyElement& vertex) {
    VertexRoles out;
    out.roles.assign(vertex.properties.size(), PlyRole::None);
    for (const Group& group : kGroups) {
        auto role = static_cast<std::size_t>(group.first);
        std::vector<std::size_t> found;
        bool isComplete = !out.has[role];
        for (const std::string_view name : group.names) {
            if (name.empty()) continue;
            const PlyProperty* const p = vertex.property(name);
            isComplete = isComplete && p && !p->countType;
            if (isComplete) found.push_back(static_cast<std::size_t>(p - vertex.properties.data()));
        }
        if (!isComplete) continue;
        for (const std::size_t i : found) {
            out.roles[i] = static_cast<PlyRole>(role);
            out.has[role++] = true;
        }
    }
    return out;
}
