// One line `keyword values` of a block, as a row of desc/properties.h describes it.
#pragma once

#include "desc/validate.h"
#include "desc/properties.h"
#include "read/txt/references.h"
#include "read/txt/scanner.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

// Fails unless the line ends here. A '{' means that the block `open` was never closed.
void expectLineEnd(Scanner& in, std::string_view after, const Token& open);
[[noreturn]] void failUnclosed(const Scanner& in, const Token& open, const Token& found);
// When the line opens another block, then it is `open` that was never closed.
[[noreturn]] void failUnknownProperty(Scanner& in, const Token& word, const Token& open,
                                      std::span<const std::string> known);

// Does it begin as a number does?
bool isNumber(const Token& t);

// Reads the numbers of one line and counts them for its messages.
class NumberLine {
public:
    NumberLine(Scanner& in, ErrorList& errors, std::string_view keyword, std::size_t count)
        : in_(in), errors_(errors), keyword_(keyword), count_(count) {}

    // What is wrong, but a number, is collected, and then leaves `value` as it is.
    // `inf` is a number where the range has no end.
    void read(double& value, const Range& range);
    void readWhole(double& value, const Range& range);
    // After the last number.
    void expectNoMore();
    void finish(const Token& open); // and the line ends

private:
    void readAny(double& value, const Range& range);
    Token nextNumber();
    std::string expected() const; // "expected 3 numbers after 'diffuse'"

    Scanner& in_;
    ErrorList& errors_;
    std::string_view keyword_;
    std::size_t count_, got_ = 0;
};

// Reads the values of a property.
class PropertyLine {
public:
    PropertyLine(Scanner& in, ErrorList& errors, References& references, const Token& open)
        : in_(in), errors_(errors), references_(references), open_(open) {}

    void read(void* block, const Property& property);
    // Where the last value stands that is a text; SourceLoc::kUnknown before one was read.
    std::uint32_t textOffset() const { return textOffset_; }

private:
    void readNumbers(void* block, const Property& property);
    void readWord(void* block, const Field& field);
    void readChoice(void* block, const Field& field);
    void readMaterials(OneOrMore<Handle>& handles, bool many);
    Token nextName(std::string_view what);
    [[noreturn]] void failExpected(const Token& t, std::string_view what) const;

    Scanner& in_;
    ErrorList& errors_;
    References& references_;
    const Token& open_;
    std::string_view keyword_;
    std::uint32_t textOffset_ = SourceLoc::kUnknown;
};
