// What a name in a scene may be, and how it is shown in a message.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

// Letters, digits and _ . - + need no quotes in the native text.
inline constexpr auto kIsBareChar = [] {
    std::array<bool, 256> table{};
    for (const char c : std::string_view("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                         "0123456789_.-+"))
        table[static_cast<unsigned char>(c)] = true;
    return table;
}();
constexpr bool isBareChar(char c) { return kIsBareChar[static_cast<unsigned char>(c)]; }
constexpr bool isBareWord(std::string_view text) {
    for (const char c : text)
        if (!isBareChar(c)) return false;
    return !text.empty();
}

// Position of the first byte that is a control character or not valid UTF-8 (RFC 3629: no
// surrogates, no overlong forms); npos when the text is good.
std::size_t findBadText(std::string_view text);

// The first character of a text that is not empty; one byte when it is bad.
std::string_view firstCharacter(std::string_view text);

// For messages: bad bytes as \xNN, at most 60 bytes.
std::string shown(std::string_view text);
