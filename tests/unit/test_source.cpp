// Places in messages: line, column, excerpt and caret.
#include "base/source.h"
#include "check.h"

namespace test_source {

namespace {

const SourceFile kFile{"a.txt", "one\ntwo three\r\n\n  four"};

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

} // namespace

TEST(source_line_and_column) {
    CHECK_EQUAL(firstLine(located(kFile, 0, "x")), "a.txt:1:1: error: x");
    CHECK_EQUAL(firstLine(located(kFile, 2, "x")), "a.txt:1:3: error: x");
    CHECK_EQUAL(firstLine(located(kFile, 3, "x")), "a.txt:1:4: error: x"); // its line end
    CHECK_EQUAL(firstLine(located(kFile, 4, "x")), "a.txt:2:1: error: x");
    CHECK_EQUAL(firstLine(located(kFile, 8, "x")), "a.txt:2:5: error: x");
    CHECK_EQUAL(firstLine(located(kFile, 15, "x")), "a.txt:3:1: error: x"); // an empty line
    CHECK_EQUAL(firstLine(located(kFile, 18, "x")), "a.txt:4:3: error: x");
    CHECK_EQUAL(firstLine(located(kFile, 22, "x")), "a.txt:4:7: error: x"); // the end
    CHECK_EQUAL(firstLine(located(kFile, 1000, "x")), "a.txt:4:7: error: x");
    CHECK_EQUAL(located({"e.txt", ""}, 0, "x"), "e.txt:1:1: error: x");
    CHECK_EQUAL(located({"e.txt", "a\n"}, 2, "x"), "e.txt:2:1: error: x");
}

TEST(source_excerpt_and_severity) {
    CHECK_EQUAL(located(kFile, 8, "bad", "warning"),
                "a.txt:2:5: warning: bad\n  two three \n      ^");
    CHECK_EQUAL(located(kFile, 15, "bad"), "a.txt:3:1: error: bad"); // nothing to show
    // Control characters would move the caret or the terminal.
    CHECK_EQUAL(located({"t", "\t\x1b[1m\tx"}, 6, "bad"),
                "t:1:7: error: bad\n    [1m x\n        ^");
}

TEST(source_long_line_is_cut) {
    const SourceFile file{"long.txt",
                          std::string(1'000'000, 'a') + "b" + std::string(1'000'000, 'c')};
    const std::string message = located(file, 1'000'000, "here");
    CHECK(message.size() < 400);
    CHECK_EQUAL(firstLine(message), "long.txt:1:1000001: error: here");
    const std::size_t excerpt = message.find("\n  ") + 1, caret = message.rfind('\n') + 1;
    CHECK_EQUAL(message[excerpt + (message.find('^') - caret)], 'b');
}

TEST(source_fail_at_throws_input_error) {
    try {
        failAt(kFile, 4, "words");
        CHECK(false);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Input);
        CHECK_EQUAL(firstLine(error.what()), "a.txt:2:1: error: words");
    }
}

// Line ends everywhere and nowhere, before places of any number: they are counted many at a time.
TEST(source_counts_the_lines_before_a_byte) {
    constexpr std::size_t kSize = 6500;
    for (const std::size_t every : {1u, 2u, 3u, 16u, 255u, 2049u}) {
        std::string text;
        for (std::size_t i = 1; i <= kSize; ++i) text += i % every == 0 ? '\n' : 'x';
        const SourceFile source{"a.txt", text};
        for (std::size_t offset = 0; offset <= kSize; ++offset)
            CHECK_EQUAL(lineOf(source, offset), 1 + offset / every);
        CHECK_EQUAL(lineOf(source, kSize + 1), 1 + kSize / every);
    }
}

} // namespace test_source
