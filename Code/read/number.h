// Numbers in scene text: correctly rounded always, and fast for the short ones that meshes consist
// of. Text must end in a byte that is no digit; std::string's terminating zero is one.
#pragma once

#include <cstdint>

enum class NumberFault { None, NotANumber, TooLarge };

template <class T> struct NumberRead {
    T value{};
    const char* end = nullptr; // behind the number when fault is None
    NumberFault fault = NumberFault::None;
};

// [+-] digits [. digits] [e[+-] digits], at least one digit before or after the point. No hex, inf,
// nan. What is too small becomes zero or a denormal number, as rounding says.
NumberRead<double> readDouble(const char* text);
NumberRead<float> readFloat(const char* text);

// Decimal digits only, up to 2^32 - 1.
inline NumberRead<std::uint32_t> readUnsigned(const char* text) {
    std::uint64_t value = 0;
    const char* p = text;
    for (; *p >= '0' && *p <= '9'; ++p) {
        value = value * 10 + static_cast<std::uint64_t>(*p - '0');
        if (value > 0xffffffffu) return {0, nullptr, NumberFault::TooLarge};
    }
    if (p == text) return {0, nullptr, NumberFault::NotANumber};
    return {static_cast<std::uint32_t>(value), p, NumberFault::None};
}
