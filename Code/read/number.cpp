#include "read/number.h"

#include <charconv>
#include <string>
#include <system_error>

namespace {

// A number as written: digits * 10^exponent, when there are few enough digits to be exact.
struct Decimal {
    std::uint64_t digits = 0;
    int digitCount = 0;        // stops counting above kExactDigits
    std::int64_t exponent = 0; // of ten
    bool negative = false;
    const char* end = nullptr; // nullptr: not a number
    const char* unsignedStart = nullptr;
};
constexpr int kExactDigits = 19; // 10^19 < 2^64

inline bool isDigit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

inline Decimal readDecimal(const char* p) {
    Decimal d;
    d.negative = *p == '-';
    if (*p == '-' || *p == '+') ++p;
    d.unsignedStart = p;
    for (; isDigit(*p); ++p) d.digits = d.digits * 10 + static_cast<std::uint64_t>(*p - '0');
    std::int64_t count = p - d.unsignedStart;
    if (*p == '.') {
        const char* fraction = ++p;
        for (; isDigit(*p); ++p) d.digits = d.digits * 10 + static_cast<std::uint64_t>(*p - '0');
        d.exponent = fraction - p;
        count += p - fraction;
    }
    if (count == 0) return {};
    d.digitCount = count > kExactDigits ? kExactDigits + 1 : static_cast<int>(count);
    if (*p == 'e' || *p == 'E') {
        ++p;
        const bool negative = *p == '-';
        if (*p == '-' || *p == '+') ++p;
        if (!isDigit(*p)) return {};
        constexpr std::int64_t kHuge = 1'000'000'000'000; // beyond what a file of digits can undo
        std::int64_t written = 0;
        for (; isDigit(*p); ++p)
            if (written < kHuge) written = written * 10 + (*p - '0');
        d.exponent += negative ? -written : written;
    }
    d.end = p;
    return d;
}

// Is the value below 1? Asked only for numbers that no double can hold.
bool isTiny(const char* p, std::int64_t exponent) {
    std::int64_t digitsFromFirst = 0;
    bool started = false;
    for (; isDigit(*p) || *p == '.'; ++p) {
        started = started || (*p != '0' && *p != '.');
        if (started && *p != '.') ++digitsFromFirst;
    }
    return digitsFromFirst + exponent <= 0;
}

template <class T> NumberRead<T> readSlowly(const Decimal& d) {
    T value = 0;
    const auto [end, error] = std::from_chars(d.unsignedStart, d.end, value);
    if (error == std::errc::result_out_of_range) {
        if (!isTiny(d.unsignedStart, d.exponent)) return {0, nullptr, NumberFault::TooLarge};
        value = 0;
    }
    return {d.negative ? -value : value, d.end, NumberFault::None};
}

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Clinger 1990: digits and the power of ten are both exact in double, so one operation rounds once.
inline bool isExactInDouble(const Decimal& d) {
    return d.digitCount <= kExactDigits && d.digits <= (std::uint64_t{1} << 53) &&
           d.exponent >= -22 && d.exponent <= 22;
}
inline double exactly(const Decimal& d) {
    const double digits = static_cast<double>(d.digits);
    const double value =
        d.exponent < 0 ? digits / kPowersOfTen[-d.exponent] : digits * kPowersOfTen[d.exponent];
    return d.negative ? -value : value;
}

} // namespace

NumberRead<double> readDouble(const char* text) {
    const Decimal d = readDecimal(text);
    if (!d.end) return {0, nullptr, NumberFault::NotANumber};
    if (!isExactInDouble(d)) return readSlowly<double>(d);
    return {exactly(d), d.end, NumberFault::None};
}

NumberRead<float> readFloat(const char* text) {
    const Decimal d = readDecimal(text);
    if (!d.end) return {0, nullptr, NumberFault::NotANumber};
    if (!isExactInDouble(d)) return readSlowly<float>(d);
    const double value = exactly(d);
    if (!roundsOnce(value)) return readSlowly<float>(d);
    return {static_cast<float>(value), d.end, NumberFault::None};
}

bool isNotFinite(std::string_view word) {
    std::string letters;
    for (const char c : word.substr(0, 10))
        if (c != '+' && c != '-') letters += static_cast<char>(c | 0x20);
    return letters == "nan" || letters == "inf" || letters == "infinity" ||
           letters.starts_with("nan(");
}
