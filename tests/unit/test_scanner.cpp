// Tokens with their places, and numbers that are correctly rounded.
#include "read/txt/scanner.h"

#include "base/text.h"
#include "check.h"
#include "desc/names.h"
#include "read/number.h"

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace test_scanner {

namespace {

std::string tokensOf(const std::string& text) {
    const SourceFile source{"t", text};
    Scanner in(source);
    std::string out;
    while (true) {
        const Token t = in.next();
        constexpr std::string_view kLetters = "wq{}nE";
        out += cat(kLetters[static_cast<std::size_t>(t.kind)], t.offset, " ");
        if (t.kind == TokenKind::FileEnd) return out;
    }
}
std::string nameOfFirst(const std::string& text) {
    const SourceFile source{"t", text};
    Scanner in(source);
    return in.nameIn(in.next());
}

// Against the C library, whose strtod and strtof round correctly.
void checkDouble(const std::string& text) {
    const auto read = readDouble(text.c_str());
    CHECK_INFO(read.fault == NumberFault::None && read.end == text.c_str() + text.size(), text);
    const double expected = std::strtod(text.c_str(), nullptr);
    CHECK_INFO(std::bit_cast<std::uint64_t>(read.value) == std::bit_cast<std::uint64_t>(expected),
               text << ": " << shortest(read.value) << " instead of " << shortest(expected));
}
void checkFloat(const std::string& text) {
    const auto read = readFloat(text.c_str());
    CHECK_INFO(read.fault == NumberFault::None && read.end == text.c_str() + text.size(), text);
    const float expected = std::strtof(text.c_str(), nullptr);
    CHECK_INFO(std::bit_cast<std::uint32_t>(read.value) == std::bit_cast<std::uint32_t>(expected),
               text << ": " << shortest(read.value) << " instead of " << shortest(expected));
}
std::string printed(const char* format, int digits, double value) {
    char buffer[64];
    const int length = std::snprintf(buffer, sizeof buffer, format, digits, value);
    CHECK(length > 0 && length < static_cast<int>(sizeof buffer));
    return buffer;
}

} // namespace

TEST(scanner_tokens_and_offsets) {
    CHECK_EQUAL(tokensOf(""), "E0 ");
    CHECK_EQUAL(tokensOf("a b\tc"), "w0 w2 w4 E5 ");
    CHECK_EQUAL(tokensOf("a{\n}\r\n"), "w0 {1 n2 }3 n5 E6 ");
    CHECK_EQUAL(tokensOf("a # b \"c\n# d\ne"), "w0 n8 n12 w13 E14 ");
    CHECK_EQUAL(tokensOf("\"a # { b\" -1.5e+3_x"), "q0 w10 E19 ");
    CHECK_EQUAL(tokensOf("# \x01\xff end"), "E8 "); // comments hold anything
}

TEST(scanner_peek_moves_nothing) {
    const SourceFile source{"t", "a b"};
    Scanner in(source);
    CHECK_EQUAL(in.peek().text, "a");
    CHECK_EQUAL(in.next().text, "a");
    CHECK_EQUAL(in.peek().text, "b");
    CHECK_EQUAL(in.lineOf(2), std::size_t{1});
}

TEST(scanner_names) {
    CHECK_EQUAL(nameOfFirst("bare_word-1.+"), "bare_word-1.+");
    CHECK_EQUAL(nameOfFirst(R"("two words")"), "two words");
    CHECK_EQUAL(nameOfFirst(R"("a \"b\" \\ c")"), "a \"b\" \\ c");
    CHECK_EQUAL(nameOfFirst("\"Größe 大 🎈\""), "Größe 大 🎈");
    CHECK_EQUAL(nameOfFirst("\"" + std::string(100000, 'x') + "\"").size(), std::size_t{100000});
}

TEST(scanner_bad_characters) {
    CHECK_THROWS(tokensOf("a ,"), "t:1:3: error: unexpected character ','");
    CHECK_THROWS(tokensOf(std::string("a\n\0", 3)), "t:2:1: error: unexpected byte '\\x00'");
    CHECK_THROWS(tokensOf("\r"), "unexpected byte '\\x0d'");
    CHECK_THROWS(tokensOf("\xc3"), "unexpected byte '\\xc3'");
    CHECK_THROWS(tokensOf("\"a"), "t:1:1: error: the text is not closed; expected '\"'");
    CHECK_THROWS(tokensOf("\"a\\"), "the text is not closed");
    CHECK_THROWS(tokensOf("\"a\\\"\n"), "the text is not closed");
    CHECK_THROWS(nameOfFirst("\"a\\tb\""), "t:1:3: error: unknown escape");
}

TEST(scanner_utf8) {
    const auto good = [](std::string_view text) {
        return findBadText(text) == std::string_view::npos;
    };
    CHECK(good("plain ~") && good("ä€😀") && good("\xf4\x8f\xbf\xbf") && good("\xed\x9f\xbf"));
    for (const std::string bad :
         {"\x80", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf",
          "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xc3", "\xe2\x82", "\x1f", "\x7f", "\n"})
        CHECK_INFO(findBadText("ab" + bad) == 2 && findBadText("ab" + bad + "c") == 2, shown(bad));
    CHECK_EQUAL(shown("a\x01ö\xff"), "a\\x01ö\\xff");
    CHECK(shown(std::string(1000, 'x')).size() < 70);
}

TEST(scanner_numbers_by_hand) {
    for (const char* text : {"0",
                             "-0",
                             "+1",
                             "1.",
                             ".5",
                             "-.5e1",
                             "1e5",
                             "1E+5",
                             "1e-5",
                             "0.1",
                             "123456789.123456789",
                             "9007199254740993",
                             "9007199254740992.99999999999999999999",
                             "1e22",
                             "1e23",
                             "8.5e22",
                             "1e-22",
                             "1e-23",
                             "1.7976931348623157e308",
                             "2.2250738585072011e-308",
                             "2.2250738585072014e-308",
                             "5e-324",
                             "2.4703282292062327208e-324",
                             "2e-324",
                             "1e-400",
                             "-1e-99999999999999999999",
                             "0e99999999999999999999",
                             "0.000000000000000000000000000001",
                             "000000000000000000000000000000012.5",
                             "18446744073709551615",
                             "18446744073709551616",
                             "99999999999999999999"})
        checkDouble(text);
    checkDouble("0." + std::string(400, '0') + "1e401");
    checkDouble("1" + std::string(400, '0') + "e-400");
    for (const char* text :
         {"0.1", "16777217", "16777217.0000000001", "16777219", "1.00000005960464477539",
          "3.4028234e38", "1.1754943e-38", "1e-45", "7e-46", "7.1e-46", "1e-60", "1e-400",
          // Half way between floats after rounding to double, but not before.
          "1.00000017881393432617187499", "1.00000017881393432617187500",
          "8388608.5000000000000001"})
        checkFloat(text);
}

TEST(scanner_numbers_random) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 100000; ++i) {
        double value = std::bit_cast<double>(random());
        if (!std::isfinite(value)) continue;
        if (i % 2 == 0) value = std::ldexp(std::fmod(value, 1.0), static_cast<int>(random() % 40));
        const int digits = static_cast<int>(random() % 21);
        checkDouble(printed("%.*e", digits, value));
        if (std::fabs(value) < 1e20) checkDouble(printed("%.*f", digits, value));
        const float single = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (std::isfinite(single)) {
            checkFloat(printed("%.*e", 1 + digits % 12, static_cast<double>(single)));
            checkFloat(shortest(single));
        }
    }
}

// Decimals so near to the middle between two floats that they round to it in double: rounding twice
// would go to the even float, whatever side the decimal is on.
TEST(scanner_floats_beside_half_way) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 100000; ++i) {
        const float low =
            std::bit_cast<float>(static_cast<std::uint32_t>(0x3a000000 + random() % 0x0c000000));
        const double middle =
            (static_cast<double>(low) + static_cast<double>(std::nextafter(low, 1e30f))) / 2;
        checkFloat(printed("%.*e", 14 + i % 5, middle));
    }
}

TEST(scanner_no_numbers) {
    for (const char* text :
         {"", "-", "+", ".", "-.", "e5", "1e", "1e+", "nan", "inf", "--1", "+-1", " 1"})
        CHECK_INFO(readDouble(text).fault == NumberFault::NotANumber, text);
    for (const char* text : {"1e309", "-1e999", "1e99999999999999999999", "1.7976931348623159e308"})
        CHECK_INFO(readDouble(text).fault == NumberFault::TooLarge, text);
    for (const char* text : {"3.5e38", "1e39", "-1e400"})
        CHECK_INFO(readFloat(text).fault == NumberFault::TooLarge, text);
    CHECK(readUnsigned("-1").fault == NumberFault::NotANumber);
    CHECK(readUnsigned("4294967296").fault == NumberFault::TooLarge);
    CHECK_EQUAL(readUnsigned("4294967295").value, 4294967295u);
    const char* const text = "0x10";
    CHECK_EQUAL(readDouble(text).end - text, std::ptrdiff_t{1}); // the caller sees the x
}

} // namespace test_scanner
