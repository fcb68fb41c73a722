// Numbers in scene text: correctly rounded always, and fast for the short ones that meshes consist
// of. Text must end in a byte that is no digit; std::string's terminating zero is one.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <string_view>

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

// Is this double, itself rounded from a number, rounded to the same float as the number? Twice errs
// only where the double lies half way between two floats, that is where its 29 extra bits are
// 1000...; below the smallest normal float there are more extra bits, and above the largest no
// float.
inline bool roundsOnce(double value) {
    constexpr std::uint64_t kExtra = (std::uint64_t{1} << 29) - 1,
                            kHalfWay = std::uint64_t{1} << 28;
    const double size = std::fabs(value);
    return size == 0 ||
           (size >= static_cast<double>(FLT_MIN) && size <= static_cast<double>(FLT_MAX) &&
            (std::bit_cast<std::uint64_t>(value) & kExtra) != kHalfWay);
}

// Do these letters stand for what is no finite number? nan, -inf, Infinity, -nan(ind) and the like,
// as programs write them in place of numbers.
bool isNotFinite(std::string_view word);

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
