// Numbers read eight digits at a time against those read digit by digit, in every bit.
#include "read/plain_number.h"

#include "check.h"

#include <bit>
#include <cstdint>
#include <random>
#include <string>

namespace test_plain_number {

namespace {

const std::string kAfter = " 3456789012345678901234567890123456789"; // what may be read ahead

std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value); }

// Is the number at the start of the text plain? If so, it is what readDouble() says.
bool isPlain(const std::string& number, const std::string& after = kAfter) {
    const std::string text = number + after;
    double value = 1e300;
    const char* const end = readPlainNumber(text.data(), text.data() + text.size(), value);
    if (!end) return false;
    const NumberRead<double> expected = readDouble(text.data());
    CHECK_INFO(expected.fault == NumberFault::None && end == expected.end &&
                   bitsOf(value) == bitsOf(expected.value),
               text << ": " << value << ", " << (end - text.data()) << " bytes");
    return true;
}

} // namespace

TEST(plain_number_knows_what_is_plain) {
    for (const char* number :
         {"0", "-0", "7", "1234567", "-0.5", "0.00000001", "12.3779449", "-0.00060021938",
          "1.234567890123", "9999999.99999999", "0.00719925474099"})
        CHECK_INFO(isPlain(number), number);
    for (const char* other : {"",
                              "-",
                              ".",
                              ".5",
                              "5.",
                              "-.5",
                              "+1",
                              "01",
                              "-00.5",
                              "12345678",
                              "1e5",
                              "1.5E-3",
                              "1.2345678901234567",
                              "0.007199254740992",
                              "99999999.5",
                              "1234567.123456789012",
                              "a",
                              "-a",
                              "1.a",
                              "\xb1"})
        CHECK_INFO(!isPlain(other), other);
    // Whoever comes near the end of the text takes the way byte by byte.
    CHECK(isPlain("12.25", std::string(27, ' ')) && !isPlain("12.25", std::string(26, ' ')));
    for (const char* after : {"", " ", "x", "\n1", ".", "e", "-"}) {
        const std::string text = "12.25" + std::string(after);
        const auto quick = readDouble(text.data(), text.data() + text.size());
        const auto slow = readDouble(text.data());
        CHECK_INFO(quick.fault == slow.fault && quick.end == slow.end, text);
    }
}

// Every byte ends a number in the same place for both, and is no digit by accident.
TEST(plain_number_ends_where_digits_end) {
    for (int byte = 0; byte < 256; ++byte)
        for (const char* number : {"1", "123", "1234567", "0.25", "0.12345678", "-1.0123456789"}) {
            const std::string after = static_cast<char>(byte) + kAfter;
            isPlain(number, after);
            isPlain(number, after.substr(0, 1) + "\xff\x80\x7f" + kAfter);
        }
}

TEST(plain_number_reads_random_digits) {
    constexpr unsigned kSeed = 17;
    std::mt19937 engine(kSeed);
    const auto random = [&](unsigned below) { return static_cast<unsigned>(engine()) % below; };
    const int cases = check::scaled(200'000);
    int plain = 0;
    for (int i = 0; i < cases; ++i) {
        std::string number = random(3) == 0 ? "-" : "";
        const auto add = [&](unsigned count) {
            for (; count > 0; --count) number += static_cast<char>('0' + random(10));
        };
        add(1 + random(random(2) == 0 ? 2u : 9u));
        if (random(8)) {
            number += '.';
            add(random(random(2) == 0 ? 9u : 18u));
        }
        if (random(30) == 0) number += "e-7";
        plain += isPlain(number);
    }
    CHECK_INFO(plain > cases / 3, plain << " of " << cases << ", seed " << kSeed);
}

} // namespace test_plain_number
