// Names of enumerators: one table per enum, used wherever one is read, written or listed.
// Knows no enum; a table is a specialisation of kEnumNames beside its enum (desc/enum_tables.h).
#pragma once

#include "base/text.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

template <class E> struct EnumName {
    E value;
    std::string_view name;
};

// template <> inline constexpr auto kEnumNames<Fruit> = std::to_array<EnumName<Fruit>>({...});
// Every enumerator has its row, in the order of the enum: see isInOrder().
template <class E> inline constexpr std::array<EnumName<E>, 0> kEnumNames{};

// For a static_assert beside the table: row i holds value i.
template <class E> consteval bool isInOrder() {
    std::size_t i = 0;
    for (const EnumName<E>& row : kEnumNames<E>)
        if (static_cast<std::size_t>(row.value) != i++) return false;
    return i > 0;
}

template <class E> constexpr std::string_view nameOf(E value) {
    return kEnumNames<E>[static_cast<std::size_t>(value)].name;
}

template <class E> constexpr std::optional<E> valueNamed(std::string_view name) {
    for (const EnumName<E>& row : kEnumNames<E>)
        if (row.name == name) return row.value;
    return {};
}

// All names of an enum, by value: what code sees that does not know the type of the enum.
template <class E>
inline constexpr auto kNamesByValue = [] {
    std::array<std::string_view, kEnumNames<E>.size()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kEnumNames<E>[i].name;
    return names;
}();

// "unknown sampler 'soboll'; did you mean 'sobol'? known: sobol, stratified, random, grid"
inline std::string unknownValue(std::string_view what, std::string_view word,
                                std::span<const std::string_view> names) {
    return cat("unknown ", what, " ",
               unknownName(word, std::vector<std::string>(names.begin(), names.end())));
}
template <class E> std::string unknownValue(std::string_view what, std::string_view word) {
    return unknownValue(what, word, kNamesByValue<E>);
}
