// One line `keyword values` of a block, as a row of desc/properties.h describes it.
#pragma once

#include "base/text.h"
#include "desc/error_list.h"
#include "desc/names.h"
#include "desc/properties.h"
#include "read/number.h"
#include "read/txt/references.h"
#include "read/txt/scanner.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// Fails unless the line ends here. A '{' means that the block `open` was never closed.
void expectLineEnd(Scanner& in, std::string_view after, const Token& open);
[[noreturn]] void failUnclosed(const Scanner& in, const Token& open, const Token& found);
// When the line opens another block, then it is `open` that was never closed.
[[noreturn]] void failUnknownProperty(Scanner& in, const Token& word, const Token& open,
                                      std::span<const std::string> known);

// Reads the numbers of one line and counts them for its messages.
class NumberLine {
public:
    NumberLine(Scanner& in, ErrorList& errors, std::string_view keyword, std::size_t count)
        : in_(in), errors_(errors), keyword_(keyword), count_(count) {}

    void read(double& value, const Range& range);
    template <class Whole>
    requires std::is_integral_v<Whole>
    void read(Whole& value, const Range& range) {
        if (const auto read = readWhole(range)) value = static_cast<Whole>(*read);
    }
    // After the last number.
    void finish(const Token& open);

private:
    void readAny(double& value, const Range& range);
    Token nextNumber();
    std::optional<long long> readWhole(const Range& range);
    std::string expected() const; // "expected 3 numbers after 'diffuse'"

    Scanner& in_;
    ErrorList& errors_;
    std::string_view keyword_;
    std::size_t count_, got_ = 0;
};

// The numbers of a property in the block before. Many blocks of a file say the same again, and a
// line is compared faster than its numbers are read.
struct LineBefore {
    std::string_view text; // behind the keyword, with the end of the line; empty: none
    std::array<double, 4> numbers{};
};

// Reads the values of a property.
template <class Block> class PropertyLine {
public:
    PropertyLine(Scanner& in, ErrorList& errors, References& references, const Token& open)
        : in_(in), errors_(errors), references_(references), open_(open) {}

    void read(Block& block, const Property<Block>& property, LineBefore& before) {
        keyword_ = property.keyword;
        if (takeAgain(block, property, before)) return;
        const std::string_view left = in_.textLeft();
        const std::size_t faultsBefore = errors_.count();
        readWord(block, property.first);
        if (auto* crop = std::get_if<Crop Block::*>(&property.first)) (block.**crop).emplace();
        std::size_t count = 0;
        const auto countOne = [&](auto&) { ++count; };
        forEachNumber(block, property.first, countOne);
        const bool isNumeric = count > 0;
        if (property.second) forEachNumber(block, *property.second, countOne);
        if (count == 0) return expectLineEnd(in_, property.keyword, open_);
        NumberLine numbers(in_, errors_, property.keyword, count);
        std::array<double, 4> got{};
        std::size_t i = 0;
        const auto readOne = [&](auto& number) {
            numbers.read(number, property.range);
            if (i < got.size()) got[i++] = static_cast<double>(number);
        };
        forEachNumber(block, property.first, readOne);
        if (property.second) forEachNumber(block, *property.second, readOne);
        numbers.finish(open_);
        if (isNumeric && count <= got.size() && errors_.count() == faultsBefore)
            before = {left.substr(0, left.size() - in_.textLeft().size()), got};
    }

private:
    bool takeAgain(Block& block, const Property<Block>& property, const LineBefore& before) {
        if (before.text.empty() || !in_.textLeft().starts_with(before.text)) return false;
        std::size_t i = 0;
        const auto take = [&](auto& number) {
            number = static_cast<std::remove_reference_t<decltype(number)>>(before.numbers[i++]);
        };
        forEachNumber(block, property.first, take);
        if (property.second) forEachNumber(block, *property.second, take);
        in_.moveTo(in_.textLeft().data() + before.text.size());
        return true;
    }
    void readWord(Block& block, const Field<Block>& field) {
        if (const auto* flag = std::get_if<bool Block::*>(&field)) {
            const Token t = in_.next();
            if (t.text != "true" && t.text != "false") failExpected(t, "true or false");
            block.** flag = t.text == "true";
        } else if (const auto* text = std::get_if<std::string Block::*>(&field)) {
            block.** text = in_.nameIn(nextName("a text"));
        } else if (const auto* reference = std::get_if<Reference<Block>>(&field)) {
            const Token t = in_.next();
            if (!isName(t)) failExpected(t, cat("the name of a ", nameOf(reference->target)));
            block.*(reference->handle) = references_.use(reference->target, t);
        } else if (const auto* choice = std::get_if<Choice<Block>>(&field)) {
            readChoice(block, *choice);
        } else if (const auto* list = std::get_if<MaterialList<Block>>(&field)) {
            readMaterials(block.*(list->handles), list->many);
        }
    }
    void readChoice(Block& block, const Choice<Block>& choice) {
        const Token t = in_.next();
        if (t.kind != TokenKind::Word)
            failExpected(t, "one of " + join(std::vector<std::string>(choice.names.begin(),
                                                                      choice.names.end())));
        for (std::size_t i = 0; i < choice.names.size(); ++i)
            if (choice.names[i] == t.text) return choice.set(block, i);
        errors_.add(locOf(t), [&] { return unknownValue(keyword_, shown(t.text), choice.names); });
    }
    void readMaterials(OneOrMore<Handle>& handles, bool many) {
        const Token first = nextName("the name of a material");
        if (!handles.empty())
            errors_.add(locOf(first), [] { return "give 'material' or 'materials', not both"; });
        handles.assign(1, references_.use(Target::Material, first));
        while (many && isName(in_.peek()))
            handles.push_back(references_.use(Target::Material, in_.next()));
    }

    static bool isName(const Token& t) {
        return t.kind == TokenKind::Word || t.kind == TokenKind::Quoted;
    }
    static SourceLoc locOf(const Token& t) { return {static_cast<std::uint32_t>(t.offset)}; }
    Token nextName(std::string_view what) {
        const Token t = in_.next();
        if (!isName(t)) failExpected(t, what);
        return t;
    }
    [[noreturn]] void failExpected(const Token& t, std::string_view what) const {
        in_.failAt(t.offset, cat("expected ", what, " after '", keyword_, "', got ", described(t)));
    }

    Scanner& in_;
    ErrorList& errors_;
    References& references_;
    const Token& open_;
    std::string_view keyword_;
};
