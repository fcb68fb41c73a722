// Names of enumerators: one list per enum, used wherever one is read, written or listed.
// Knows no enum (those of scenes are in desc/enum_tables.h).
#pragma once

#include "base/text.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Each enum with names has a function beside it that returns all of them, in the order of the enum:
//     constexpr auto wordsOf(Fruit) { return words("apple", "pear"); }
template <class... Names> constexpr auto words(Names... all) {
    return std::array<std::string_view, sizeof...(Names)>{all...};
}

// The names of an enum by value; a span of them is what code sees that does not know the enum.
template <class E> inline constexpr auto kNamesByValue = wordsOf(E{});
// All values of an enum with names.
template <class E>
inline constexpr auto kValuesOf = [] {
    std::array<E, kNamesByValue<E>.size()> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<E>(i);
    return values;
}();

template <class E> constexpr std::string_view nameOf(E value) {
    return kNamesByValue<E>[static_cast<std::size_t>(value)];
}

template <class E> constexpr std::optional<E> valueNamed(std::string_view name) {
    for (const E value : kValuesOf<E>)
        if (nameOf(value) == name) return value;
    return {};
}

// "unknown sampler 'soboll'; did you mean 'sobol'? known: sobol, stratified, random, grid"
inline std::string unknownValue(std::string_view what, std::string_view word,
                                std::span<const std::string_view> names) {
    return cat("unknown ", what, " ",
               unknownName(word, std::vector<std::string>(names.begin(), names.end())));
}
template <class E> std::string unknownValue(std::string_view what, std::string_view word) {
    return unknownValue(what, word, kNamesByValue<E>);
}
