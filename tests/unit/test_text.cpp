#include "base/text.h"
#include "check.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace test_text {

TEST(text_shortest_round_trips) {
    CHECK_EQUAL(shortest(0.1), "0.1");
    CHECK_EQUAL(shortest(0.1f), "0.1");
    CHECK_EQUAL(shortest(3.0), "3");
    CHECK_EQUAL(shortest(1e-20), "1e-20");
    CHECK_EQUAL(shortest(-0.0), "-0");
    std::mt19937_64 engine(41);
    for (int i = 0; i < 100000; ++i) {
        const double value = std::bit_cast<double>(engine());
        if (!std::isfinite(value)) continue;
        const auto back = parseDouble(shortest(value));
        CHECK_INFO(back &&
                       std::bit_cast<std::uint64_t>(*back) == std::bit_cast<std::uint64_t>(value),
                   value);
        const float single = std::bit_cast<float>(static_cast<std::uint32_t>(engine()));
        if (!std::isfinite(single)) continue;
        const auto same = parseDouble(shortest(single));
        CHECK_INFO(same && static_cast<float>(*same) == single, single);
    }
}

TEST(text_parse_double) {
    CHECK_EQUAL(parseDouble("1.5").value_or(0), 1.5);
    CHECK_EQUAL(parseDouble("+1.5").value_or(0), 1.5);
    CHECK_EQUAL(parseDouble("-2e3").value_or(0), -2000.0);
    CHECK_EQUAL(parseDouble(".5").value_or(0), 0.5);
    CHECK_EQUAL(parseDouble("5.").value_or(0), 5.0);
    CHECK_EQUAL(parseDouble("5e-324").value_or(0), 5e-324);
    // Too small for a double is no error of whoever wrote it: the nearest number is 0.
    CHECK_EQUAL(parseDouble("1e-400").value_or(1), 0.0);
    CHECK_EQUAL(parseDouble("-0.0001e-400").value_or(1), 0.0);
    CHECK_EQUAL(parseDouble("0e999999999999").value_or(1), 0.0);
    for (const char* bad : {"",         "+",     "-",      ".",   "+-5",  "++5",   "--5",  "- 5",
                            "5 ",       " 5",    "1.5x",   "1,5", "0x10", "inf",   "-inf", "nan",
                            "infinity", "1e999", "-1e999", "1e",  "e5",   "1e5.5", "1e400"})
        CHECK_INFO(!parseDouble(bad), "'" << bad << "'");
}

TEST(text_parse_integer) {
    CHECK_EQUAL(parseInteger("42").value_or(0), 42);
    CHECK_EQUAL(parseInteger("+42").value_or(0), 42);
    CHECK_EQUAL(parseInteger("-42").value_or(0), -42);
    CHECK_EQUAL(parseInteger("9223372036854775807").value_or(0),
                std::numeric_limits<long long>::max());
    for (const char* bad : {"", "+", "-", "+-5", "++5", "5.0", "1e3", "5 ", " 5", "0x10",
                            "9223372036854775808", "99999999999999999999999"})
        CHECK_INFO(!parseInteger(bad), "'" << bad << "'");
}

TEST(text_join_and_cat) {
    CHECK_EQUAL(join({}), "");
    const std::vector<std::string> one{"a"}, three{"a", "b", "c"};
    CHECK_EQUAL(join(one), "a");
    CHECK_EQUAL(join(three), "a, b, c");
    CHECK_EQUAL(join(three, "|"), "a|b|c");
    const std::vector<std::string> empty{"", "b"};
    CHECK_EQUAL(join(empty), ", b");
    CHECK_EQUAL(cat("x = ", 3, ", y = ", 0.5, 'z'), "x = 3, y = 0.5z");
}

TEST(text_nearest_word) {
    const std::vector<std::string> known{"golden", "red", "glass", "sphere"};
    CHECK_EQUAL(nearestWord("gold", known).value_or(""), "golden");
    CHECK_EQUAL(nearestWord("go", known).value_or(""), "");
    CHECK_EQUAL(nearestWord("goldn", known).value_or(""), "golden");
    CHECK_EQUAL(nearestWord("lgass", known).value_or(""), "glass"); // a swap of neighbours is one
    CHECK_EQUAL(nearestWord("glas", known).value_or(""), "glass");
    CHECK_EQUAL(nearestWord("Red", known).value_or(""), "red");
    CHECK(!nearestWord("torus", known));
    CHECK(!nearestWord("red", {}));
    CHECK_EQUAL(nearestWord("glass", known).value_or(""), "glass");
}

TEST(text_unknown_name) {
    const std::vector<std::string> known{"golden", "red", "glass"};
    CHECK_EQUAL(unknownName("goldn", known),
                "'goldn'; did you mean 'golden'? known: golden, red, glass");
    CHECK_EQUAL(unknownName("torus", known), "'torus'; known: golden, red, glass");
    CHECK_EQUAL(unknownName("torus", {}), "'torus'; there are none");
    std::vector<std::string> many;
    for (int i = 0; i < 15; ++i) many.push_back(cat("name", i * 1111));
    const std::string text = unknownName("torus", many);
    CHECK(text.find("name13332") == std::string::npos);
    CHECK(text.ends_with(", name12221 and 3 more"));
}

TEST(text_after_the_last) {
    CHECK_EQUAL(afterLast("a/b.obj", "/"), "b.obj");
    CHECK_EQUAL(afterLast("a/b\\c.obj", "/\\"), "c.obj");
    CHECK_EQUAL(afterLast("c.obj", "/\\"), "c.obj");
    CHECK_EQUAL(afterLast("a/", "/"), "");
}

} // namespace test_text
