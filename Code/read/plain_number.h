// The numbers that scene text consists of, "0.25", "-17", "12.3794449", eight digits at a time. How
// many digits a number has can't be guessed: a loop over them costs more for leaving it than for
// what it does.
#pragma once

#include "read/number.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

// Up to eight digits at the start of eight bytes.
struct EightDigits {
    std::uint32_t value = 0;
    int count = 0; // of digits
};
inline EightDigits digitsAt(const char* p) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, p, sizeof bytes); // the first one lowest
    bytes ^= 0x3030303030303030u;         // digits become 0 to 9, and nothing else does
    const std::uint64_t others =
        (bytes | (bytes + 0x7676767676767676u)) & 0x8080808080808080u; // right up to the first one
    const int count = others == 0 ? 8 : std::countr_zero(others) / 8;
    // Zeros in front, then sums of neighbours: of digits, of pairs, of fours (Lemire, Mula 2018).
    bytes = count == 0 ? 0 : bytes << (64 - 8 * count);
    bytes = bytes * 10 + (bytes >> 8);
    constexpr std::uint64_t kPairs = 0x000000ff000000ffu;
    bytes = (bytes & kPairs) * (100 + (std::uint64_t{1'000'000} << 32)) +
            ((bytes >> 16) & kPairs) * (1 + (std::uint64_t{10'000} << 32));
    return {static_cast<std::uint32_t>(bytes >> 32), count};
}

// -? digits (. digits)?, without a zero in front of other digits: what JSON takes as well. nullptr
// for all other numbers, for those that are long or near the end of the text, and for what is none:
// readDouble() knows these. Else the place behind the number, which may be one that no number can
// have behind it.
inline const char* readPlainNumber(const char* text, const char* end, double& value) {
    if constexpr (std::endian::native != std::endian::little) return nullptr;
    constexpr std::ptrdiff_t kMostRead = 32;
    constexpr int kMostDigits = 15; // 10^15 < 2^53
    if (end - text < kMostRead) return nullptr;
    static constexpr std::uint64_t kTens[] = {1,      10,      100,      1000,     10000,
                                              100000, 1000000, 10000000, 100000000};
    static constexpr double kPowers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6, 1e7,
                                         1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14};
    const bool isNegative = *text == '-';
    const char* p = text + isNegative;
    // Most have one digit in front of the point.
    const auto isDigit = [](char c) { return static_cast<unsigned char>(c - '0') < 10; };
    const bool isShort = isDigit(p[0]) && !isDigit(p[1]);
    const EightDigits whole =
        isShort ? EightDigits{static_cast<std::uint32_t>(p[0] - '0'), 1} : digitsAt(p);
    if (whole.count == 0 || whole.count == 8 || (*p == '0' && whole.count > 1)) return nullptr;
    p += whole.count;
    std::uint64_t digits = whole.value;
    int behindPoint = 0;
    if (*p == '.') {
        // Both at the same time, whether the second ones are needed or not.
        const EightDigits first = digitsAt(++p), next = digitsAt(p + 8);
        if (first.count == 0) return nullptr;
        const EightDigits second = first.count == 8 ? next : EightDigits{};
        behindPoint = first.count + second.count;
        if (behindPoint >= kMostDigits || whole.count + behindPoint > kMostDigits) return nullptr;
        digits = (digits * kTens[first.count] + first.value) * kTens[second.count] + second.value;
        p += behindPoint;
    }
    if (*p == 'e' || *p == 'E') return nullptr;
    // Clinger 1990, as in readDouble().
    const double size =
        static_cast<double>(static_cast<std::int64_t>(digits)) / kPowers[behindPoint];
    value = isNegative ? -size : size;
    return p;
}

// readDouble() for a text that goes on up to `end`.
inline NumberRead<double> readDouble(const char* text, const char* end) {
    double value = 0;
    if (const char* const behind = readPlainNumber(text, end, value))
        return {value, behind, NumberFault::None};
    return readDouble(text);
}
