// The JSON parser: what RFC 8259 allows is read, everything else is refused with a place and words.
#include "read/json/json.h"

#include "base/text.h"
#include "check.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace test_json {

namespace {

std::string faultOf(const std::string& text) {
    return check::thrown([&] { parseJson({"t.json", text}); });
}

// The tree again as JSON, without blanks: what was understood.
void write(const JsonValue& value, std::string& out) {
    switch (value.kind()) {
    case JsonValue::Kind::Null: out += "null"; return;
    case JsonValue::Kind::Bool: out += value.boolean() ? "true" : "false"; return;
    case JsonValue::Kind::Number: out += shortest(value.number()); return;
    case JsonValue::Kind::String: out += cat('"', value.text(), '"'); return;
    case JsonValue::Kind::Array:
        out += '[';
        for (const JsonValue& item : value.items()) write(item, out), out += ',';
        out += ']';
        return;
    case JsonValue::Kind::Object:
        out += '{';
        for (const JsonMember& member : value.members()) {
            out += cat('"', member.key, "\":");
            write(member.value, out);
            out += ',';
        }
        out += '}';
        return;
    }
}
std::string understood(const std::string& text) {
    const SourceFile source{"t.json", text};
    std::string out;
    write(parseJson(source).root, out);
    return out;
}

std::string repeated(std::string_view part, std::size_t count) {
    std::string out;
    for (std::size_t i = 0; i < count; ++i) out += part;
    return out;
}

} // namespace

TEST(json_accepts) {
    struct Row {
        std::string text, expected;
    };
    const std::string zero(1, '\0');
    const std::vector<Row> rows = {
        // Values of every kind, alone and with every blank around them.
        {"null", "null"},
        {"true", "true"},
        {" \t\r\nfalse \t\r\n", "false"},
        {"[]", "[]"},
        {"[ ]", "[]"},
        {"{}", "{}"},
        {"{\n}", "{}"},
        {"[[],[[]],{}]", "[[],[[],],{},]"},
        {"[null,true,false]", "[null,true,false,]"},
        {R"({"a":{"b":[1]},"c":""})", R"({"a":{"b":[1,],},"c":"",})"},
        {R"({"":0," ":1})", R"({"":0," ":1,})"},
        {R"({"A":0,"a":1})", R"({"A":0,"a":1,})"},
        // Numbers by the grammar.
        {"0", "0"},
        {"-0", "-0"},
        {"-1", "-1"},
        {"10", "10"},
        {"0.5", "0.5"},
        {"0e0", "0"},
        {"1e5", "1e+05"},
        {"1E+2", "100"},
        {"1e-2", "0.01"},
        {"1.25e02", "125"},
        {"-0.0", "-0"},
        {"0.1000000000000000055511151231257827", "0.1"},
        {"123456789012345678901234567890", "1.2345678901234568e+29"},
        {"1e-400", "0"},
        {"4.9e-324", "5e-324"},
        {"1.7976931348623157e308", "1.7976931348623157e+308"},
        // Texts: escapes, and UTF-8 as it is.
        {R"("a\"\\\/\b\f\n\r\tz")", "\"a\"\\/\b\f\n\r\tz\""},
        {R"("\u0041\u00e9\u20AC\ud83d\ude00")", "\"A\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\""},
        {R"("\u0000")", cat('"', zero, '"')},
        {R"("\uffff\ud7ff\ue000")", "\"\xef\xbf\xbf\xed\x9f\xbf\xee\x80\x80\""},
        {R"("\\u0041")", "\"\\u0041\""},
        {"\"\x7f\"", "\"\x7f\""},
        {"\"\xc2\x80\xdf\xbf\xe0\xa0\x80\xef\xbf\xbf\xf0\x90\x80\x80\xf4\x8f\xbf\xbf\"",
         "\"\xc2\x80\xdf\xbf\xe0\xa0\x80\xef\xbf\xbf\xf0\x90\x80\x80\xf4\x8f\xbf\xbf\""},
        {"\"\xe2\x80\xa8 // # ' , ] }\"", "\"\xe2\x80\xa8 // # ' , ] }\""},
        {R"({"\u0061b":1})", R"({"ab":1,})"},
    };
    for (const Row& row : rows) {
        std::string got;
        const std::string fault = check::thrown([&] { got = understood(row.text); });
        CHECK_INFO(fault.empty() && got == row.expected,
                   "text " << row.text << " gives " << got << fault);
    }
    CHECK_EQUAL(understood(repeated("[", kDeepestJson) + repeated("]", kDeepestJson)).size(),
                std::size_t{2 * kDeepestJson + kDeepestJson - 1});
}

TEST(json_rejects) {
    struct Row {
        std::string text, expected; // "line:col: error: words"
    };
    const std::string zero(1, '\0');
    const std::vector<Row> rows = {
        // Files.
        {"", "1:1: error: the file is empty"},
        {" \n ", "2:2: error: the file is empty"},
        {"\xef\xbb\xbf", "1:4: error: the file is empty"}, // a byte order mark is skipped
        {"\xef\xbb\xbf[]]", "1:6: error: expected the end of the file, got ']'"},
        {"\xff\xfe{", "1:1: error: expected a value, got '\\xff'"},
        {"1 2", "1:3: error: expected the end of the file, got '2'"},
        {"[]]", "1:3: error: expected the end of the file, got ']'"},
        {"{}\n#", "2:1: error: expected the end of the file, got '#'"},
        {cat("[1]", zero), "1:4: error: expected the end of the file, got '\\x00'"},
        // Words.
        {"nul", "1:1: error: expected a value, got 'nul'; texts stand in double quotes"},
        {"nulll", "got 'nulll'"},
        {"true1", "got 'true1'"},
        {"True", "1:1: error: expected a value, got 'True'; JSON writes true, false and null"},
        {"None", "JSON writes true, false and null"},
        {"NaN", "JSON has finite numbers only"},
        {"-Infinity", "1:1: error: a number needs a digit after '-'"},
        {"Infinity", "JSON has finite numbers only"},
        {"undefined", "1:1: error: expected a value, got 'undefined'"},
        // Numbers.
        {"01", "1:1: error: a number has no zeros before its first digit"},
        {"-012", "1:1: error: a number has no zeros before its first digit"},
        {"00", "no zeros before"},
        {"+1", "1:1: error: expected a value, got '+1'; a number starts with a digit or '-'"},
        {".5", "1:1: error: expected a value, got '.5'; a number starts with a digit or '-'"},
        {"-.5", "1:1: error: a number needs a digit after '-'"},
        {"5.", "1:1: error: a number needs a digit after the decimal point"},
        {"5.e3", "a number needs a digit after the decimal point"},
        {"1e", "1:1: error: a number needs a digit in the exponent"},
        {"1e+", "a number needs a digit in the exponent"},
        {"1.5E-", "a number needs a digit in the exponent"},
        {"-", "1:1: error: a number needs a digit after '-'"},
        {"--1", "a number needs a digit after '-'"},
        {"0x1F", "1:1: error: expected a number, got '0x1F'; JSON has decimal numbers only"},
        {"1_000", "1:1: error: expected a number, got '1_000'"},
        {"1.2.3", "1:1: error: expected a number, got '1.2.3'"},
        {"1f", "1:1: error: expected a number, got '1f'"},
        {"[1 2]", "1:4: error: expected ',' or ']' after an item of an array, got '2'"},
        {"1e309", "1:1: error: the number is too large"},
        {"[0,-1e999]", "1:4: error: the number is too large"},
        {"\xef\xbc\x91", "got '\xef\xbc\x91'"}, // full-width digit one
        // Arrays.
        {"[", "1:2: error: expected a value, got the end of the file"},
        {"[1", "1:3: error: expected ',' or ']' before the end of the file; '[' was opened at "
               "line 1"},
        {"[1,", "1:4: error: expected a value, got the end of the file"},
        {"[1,]", "1:3: error: a ',' before ']'; the last item has none after it"},
        {"[,1]", "1:2: error: expected a value, got ','"},
        {"[1,,2]", "1:4: error: expected a value, got ','"},
        {"[1}", "1:3: error: expected ',' or ']' after an item of an array, got '}'"},
        {"]", "1:1: error: expected a value, got ']'"},
        {"[1, // one\n2]", "1:5: error: expected a value, got '/'; JSON has no comments"},
        // Objects.
        {"{", "1:2: error: expected a key in double quotes before the end of the file"},
        {"{\"a\"", "1:5: error: expected ':' after the key 'a', got the end of the file"},
        {"{\"a\":", "1:6: error: expected a value, got the end of the file"},
        {"{\"a\":1", "expected ',' or '}' before the end of the file; '{' was opened at line 1"},
        {"{\"a\":1,}", "1:7: error: a ',' before '}'; the last item has none after it"},
        {"{\"a\" 1}", "1:6: error: expected ':' after the key 'a', got '1'"},
        {"{\"a\":1 \"b\":2}",
         "1:8: error: expected ',' or '}' after a value of an object, got '\"'"},
        {"{a:1}", "1:2: error: expected a key in double quotes, got 'a'"},
        {"{'a':1}", "1:2: error: expected a key in double quotes, got '''"},
        {"{1:1}", "1:2: error: expected a key in double quotes, got '1'"},
        {"{\"a\":}", "1:6: error: expected a value, got '}'"},
        {"{,}", "expected a key in double quotes, got ','"},
        {"{\"a\":1,\n \"a\":2}",
         "2:2: error: the key 'a' was given already at line 1; an object has each key once"},
        {"{\"a\":1,\"b\":2,\"\\u0061\":3}", "1:14: error: the key 'a' was given already"},
        // Texts.
        {"\"", "1:1: error: the text is not closed"},
        {"[\"abc]", "1:2: error: the text is not closed"},
        {"\"abc\\\"", "1:1: error: the text is not closed"},
        {"\"a\nb\"", "1:1: error: the text is not closed"},
        {"\"a\tb\"", "1:3: error: control character \\x09 in a text; write it as \\t or \\u0009"},
        {cat("\"", zero, "\""), "1:2: error: control character \\x00 in a text"},
        {"\"\x1f\"", "1:2: error: control character \\x1f"},
        {"'a'", "1:1: error: expected a value, got '''; texts stand in double quotes"},
        {R"("\x41")", "1:2: error: unknown escape '\\x'; known: \\\" \\\\ \\/ \\b"},
        {R"("\'")", "1:2: error: unknown escape '\\''"},
        {R"("\U0041")", "unknown escape '\\U'"},
        {"\"\\\xc3\xa9\"", "1:2: error: unknown escape '\\\xc3\xa9'"},
        {"\"\\\n\"", "the text is not closed"},
        {R"("\u12")", "1:2: error: expected four hexadecimal digits after '\\u'"},
        {R"("\u12G4")", "1:2: error: expected four hexadecimal digits after '\\u'"},
        {R"("\u")", "1:2: error: expected four hexadecimal digits after '\\u'"},
        {R"("ab\ud800")", "1:4: error: '\\ud800' is half of a surrogate pair"},
        {R"("\ud800x")", "1:2: error: '\\ud800' is half of a surrogate pair"},
        {R"("\ud800\n")", "1:2: error: '\\ud800' is half of a surrogate pair"},
        {R"("\ud83d\u0041")", "1:2: error: '\\ud83d' is half of a surrogate pair"},
        {R"("\ud83d\ud83d")", "1:2: error: '\\ud83d' is half of a surrogate pair"},
        {R"("\udc00")", "1:2: error: '\\udc00' is half of a surrogate pair"},
        {R"("\ude00\ud83d")", "1:2: error: '\\ude00' is half of a surrogate pair"},
        // UTF-8: lone parts, overlong forms, surrogates, beyond U+10FFFF, cut off.
        {"\"\x80\"", "1:2: error: byte \\x80 is not UTF-8"},
        {"\"a\xff\"", "1:3: error: byte \\xff is not UTF-8"},
        {"\"\xc0\xaf\"", "byte \\xc0 is not UTF-8"},
        {"\"\xe0\x80\xaf\"", "byte \\xe0 is not UTF-8"},
        {"\"\xed\xa0\x80\"", "byte \\xed is not UTF-8"},
        {"\"\xf4\x90\x80\x80\"", "byte \\xf4 is not UTF-8"},
        {"\"\xf8\x88\x80\x80\x80\"", "byte \\xf8 is not UTF-8"},
        {"\"\xc3\"", "byte \\xc3 is not UTF-8"},
        {"\"\xe2\x82", "byte \\xe2 is not UTF-8"},
        {"{\"\xc3(\":1}", "1:3: error: byte \\xc3 is not UTF-8"},
        // Blanks that are none in JSON.
        {"[\f]", "1:2: error: expected a value, got '\\x0c'"},
        {"\xc2\xa0[]", "1:1: error: expected a value, got '\xc2\xa0'"},
        {"[1,\v2]", "1:4: error: expected a value, got '\\x0b'"},
    };
    for (const Row& row : rows) {
        const std::string fault = faultOf(row.text);
        CHECK_INFO(fault.find(row.expected) != std::string::npos,
                   "text " << row.text << "\nexpected " << row.expected << "\ngot " << fault);
    }
}

TEST(json_depth_is_bounded) {
    const std::string words = "arrays and objects are nested more than 256 deep";
    for (const std::string_view open : {"[", "{\"a\":", "[{\"a\":"}) {
        const std::string fault = faultOf(repeated(open, 1'000'000));
        CHECK_INFO(fault.find(words) != std::string::npos, open << ": " << fault);
    }
    CHECK(faultOf(repeated("[", 257)).find("t.json:1:257: error: " + words) != std::string::npos);
}

TEST(json_places) {
    const SourceFile source{"t.json", "{ \"a\": [1,\n \"x\\u0041\"] }"};
    const JsonDocument document = parseJson(source);
    CHECK_EQUAL(document.root.loc().offset, 0u);
    const JsonMember& a = document.root.members()[0];
    CHECK_EQUAL(a.loc.offset, 2u);
    CHECK_EQUAL(a.value.loc().offset, 7u);
    CHECK_EQUAL(a.value.items()[0].loc().offset, 8u);
    CHECK_EQUAL(a.value.items()[1].loc().offset, 12u);
    CHECK_EQUAL(a.value.items()[1].text(), "xA");
    CHECK(document.root.find("a") == &a.value && document.root.find("b") == nullptr);
    // Asked for what it is not, a value is empty.
    CHECK(a.value.number() == 0 && a.value.text().empty() && a.value.members().empty());
    CHECK(a.value.find("a") == nullptr && document.root.items().empty());
}

TEST(json_many_keys) {
    std::string text = "{";
    for (int i = 0; i < 1000; ++i) text += cat("\"k", i, "\":", i, ",\n");
    const SourceFile source{"t.json", text + "\"last\":true}"};
    const JsonDocument document = parseJson(source);
    CHECK_EQUAL(document.root.members().size(), std::size_t{1001});
    CHECK_EQUAL(document.root.find("k999")->number(), 999.0);
    CHECK_THROWS(parseJson({"t.json", text + "\"k500\":0}"}),
                 "t.json:1001:1: error: the key 'k500' was given already at line 501");
}

// Doubles of every size come back to the last bit, written short and written long.
TEST(json_numbers_are_rounded_correctly) {
    std::mt19937_64 random(7);
    for (int i = 0; i < check::scaled(3000); ++i) {
        const auto value = std::bit_cast<double>(random());
        if (!std::isfinite(value)) continue;
        char longer[40];
        static_cast<void>(std::snprintf(longer, sizeof longer, "%.25e", value));
        const SourceFile source{"t.json", cat("[", shortest(value), ",", longer, "]")};
        const JsonDocument document = parseJson(source);
        for (const JsonValue& item : document.root.items())
            CHECK_INFO(std::bit_cast<std::uint64_t>(item.number()) ==
                           std::bit_cast<std::uint64_t>(value),
                       std::string_view(source.text) << " gives " << shortest(item.number()));
    }
}

// What is wider in JSON5 (json5.org) than in JSON.
TEST(json5_accepts) {
    struct Row {
        std::string text, expected, liberty;
    };
    const std::vector<Row> rows = {
        {"[1, 2]", "[1,2,]", ""},
        {R"({"a": "b\n\u0041"})", "{\"a\":\"b\nA\",}", ""},
        {"// one\n[1] // two", "[1,]", "1:1 a comment"},
        {"[1, /* // ] */ 2]", "[1,2,]", "1:5 a comment"},
        {"/**/{}/***/", "{}", "1:1 a comment"},
        {"\xc2\xa0[\v1\f]\xe2\x80\xa8", "[1,]", "1:1 a blank"},
        {"[1, 2,]", "[1,2,]", "1:6 a ',' before ']'"},
        {"{\"a\": 1 , }", "{\"a\":1,}", "1:9 a ',' before '}'"},
        {"{a: 1, $b_2: 2, _: 3}", "{\"a\":1,\"$b_2\":2,\"_\":3,}", "1:2 a key without quotes"},
        {"{'a b': 'c\"d'}", "{\"a b\":\"c\"d\",}", "1:2 a key in single quotes"},
        {R"(['it\'s', "it's"])", R"(["it's","it's",])", "1:2 a text in single quotes"},
        {R"(["\x41\v\0\'\a\"", 1])", cat("[\"A\v", std::string(1, '\0'), "'a\"\",1,]"),
         "1:3 an escape of this kind"},
        {"[\"two \\\nlines, \\\r\nthree\"]", "[\"two lines, three\",]", "1:7 an escape"},
        {"[.5, 5., +5, -.5, 5.e1, +.5e-1]", "[0.5,5,5,-0.5,50,0.05,]", "1:2 the number .5"},
        {"[0x1F, -0Xff, +0x0]", "[31,-255,0,]", "1:2 the number 0x1F"},
        {"[1.5, -0, 2e3, 0.25]", "[1.5,-0,2000,0.25,]", ""},
    };
    for (const Row& row : rows) {
        const SourceFile source{"t.json", row.text};
        std::string got, liberty;
        const std::string fault = check::thrown([&] {
            const JsonDocument document = parseJson(source, JsonGrammar::Json5);
            write(document.root, got);
            CHECK(document.liberties.size() <= 1); // the first of JSON5 stands for all
            for (const JsonLiberty& l : document.liberties)
                liberty = located(source, l.loc.offset, l.what, "warning");
        });
        CHECK_INFO(fault.empty() && got == row.expected, row.text << " gives " << got << fault);
        const std::size_t blank = row.liberty.find(' ');
        const std::string wanted = row.liberty.empty()
                                       ? ""
                                       : cat("t.json:", row.liberty.substr(0, blank),
                                             ": warning: ", row.liberty.substr(blank + 1));
        CHECK_INFO(liberty.substr(0, wanted.size()) == wanted && liberty.empty() == wanted.empty(),
                   row.text << " says " << liberty);
    }
}

TEST(json5_rejects) {
    const std::vector<std::pair<std::string, std::string>> rows = {
        {"", "1:1: error: the file is empty"},
        {"[NaN]", "1:2: error: expected a value, got 'NaN'; JSON has finite numbers only"},
        {"[.5, NaN]", "1:6: error: expected a value, got 'NaN'; a scene has finite numbers only"},
        {"[.5, +Infinity]", "1:6: error: expected a value, got '+Infinity'; a scene has finite"},
        {"[.5, 012]", "1:6: error: a number has no zeros before its first digit"},
        {"[.5, .]", "1:6: error: a number needs a digit"},
        {"[.5, +]", "1:6: error: expected a value, got '+'"},
        {"[.5, 1e]", "1:6: error: a number needs a digit in the exponent"},
        {"[.5, 0xg]", "1:6: error: expected a number, got '0xg'"},
        {"[.5, 1e999]", "1:6: error: the number is too large"},
        {"[.5, 1.2.3]", "1:6: error: expected a number, got '1.2.3'"},
        {"[1,,]", "1:4: error: expected a value, got ','"},
        {"[,]", "1:2: error: expected a value, got ','"},
        {"{,}", "1:2: error: expected a key in double quotes, got ','"},
        {"{1: 2,}", "1:2: error: expected a key in double quotes, got '1'"},
        {"['a\nb']",
         "1:2: error: the text is not closed; expected \"'\" before the end of the line"},
        {"['a", "1:2: error: the text is not closed"},
        {"['a\\", "1:2: error: the text is not closed"},
        {"['\xff']", "1:3: error: byte \\xff is not UTF-8"},
        {"['\\\xff']", "is not UTF-8"},
        {"['\\x4']", "1:3: error: expected two hexadecimal digits after '\\x'"},
        {"['\\u12']", "1:3: error: expected four hexadecimal digits"},
        {"['\\01']", "1:3: error: a '\\' before a digit means nothing"},
        {"[1] /* two", "1:5: error: the comment is not closed"},
        {"[1] / 2", "1:5: error: expected the end of the file, got '/'"},
        {"[True,]", "1:2: error: expected a value, got 'True'"},
        {"{a: 1, 'a': 2}", "1:8: error: the key 'a' was given already at line 1"},
    };
    for (const auto& row : rows) {
        const std::string &text = row.first, &expected = row.second;
        const std::string fault = check::thrown([&] {
            parseJson({"t.json", text}, JsonGrammar::Json5);
        });
        CHECK_INFO(fault.find(expected) != std::string::npos, text << " says " << fault);
    }
}

// Under --lenient the last of two equal keys holds, as in other programs.
TEST(json_lenient_keys_given_twice) {
    std::string many;
    for (int i = 0; i < 40; ++i) many += cat("\"k", i % 20, "\":", i, ",");
    for (const auto& [text, expected, count] :
         {std::tuple(std::string(R"({"a":1,"b":2,"a":3})"), std::string(R"({"b":2,"a":3,})"), 1u),
          std::tuple(std::string(R"([{"a":{"c":1,"c":2},"a":4},5])"),
                     std::string(R"([{"a":4,},5,])"), 2u),
          std::tuple("{" + many + "}", cat("{", many.substr(many.find("\"k0\":20")), "}"), 21u)}) {
        const SourceFile source{"t.json", text};
        const JsonDocument document = parseJson(source, JsonGrammar::Lenient);
        std::string got;
        write(document.root, got);
        CHECK_INFO(got == expected, text << " gives " << got);
        CHECK_EQUAL(document.liberties.size(), std::size_t{count});
    }
}

} // namespace test_json
