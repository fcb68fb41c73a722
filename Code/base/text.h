// Small text helpers: joining, exact numbers, and the nearest known word for an error message.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

void appendWhole(std::string& out, long long value);
void appendWhole(std::string& out, unsigned long long value);
void appendNumber(std::string& out, double value); // by six digits, as a stream would: "0.333333"
template <class Part> void appendTo(std::string& out, const Part& part) {
    if constexpr (std::is_convertible_v<const Part&, std::string_view>)
        out += std::string_view(part);
    else if constexpr (std::is_same_v<Part, char>)
        out += part;
    else if constexpr (std::is_floating_point_v<Part>)
        appendNumber(out, static_cast<double>(part));
    else {
        static_assert(std::is_integral_v<Part> && sizeof(Part) > 1);
        using Whole = std::conditional_t<std::is_signed_v<Part>, long long, unsigned long long>;
        appendWhole(out, static_cast<Whole>(part));
    }
}
// Joins texts, characters and numbers.
template <class... Parts> std::string cat(const Parts&... parts) {
    std::string out;
    (appendTo(out, parts), ...);
    return out;
}

// The shortest decimal text that reads back to the same double ("0.1", "1e-20", "3").
std::string shortest(double value);
std::string shortest(float value);
// Three digits that count: "0.00594".
std::string significant(double value);

// The whole text as one finite number / whole number; nothing when it is not exactly that.
std::optional<double> parseDouble(std::string_view text);
std::optional<long long> parseInteger(std::string_view text);

// What stands behind the last of these characters: all of it when there is none.
std::string afterLast(std::string_view text, std::string_view characters);
// ".png" for "a.PNG"; empty when there is none.
std::string lowerExtension(const std::string& fileName);

// "a, b, c"
std::string join(std::span<const std::string> words, std::string_view separator = ", ");

// The known word with the smallest edit distance, if that is close enough to be a typing error
// (at most a third of the letters, at least one); else the first one that begins with it.
std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> known);

// "'word'; did you mean 'x'? known: a, b, c": the end of every message about an unknown name.
// Lists of more than 12 names are cut.
std::string unknownName(std::string_view word, std::span<const std::string> known);
