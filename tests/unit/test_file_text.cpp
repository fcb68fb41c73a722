// The text of a file: its bytes, and a zero behind them whatever was done with it.
#include "base/file_text.h"
#include "check.h"

#include <cstring>
#include <utility>

namespace test_file_text {

namespace {

bool says(const FileText& text, std::string_view what) {
    return std::string_view(text) == what && text.size() == what.size() &&
           text.empty() == what.empty() && text.end() - text.begin() == std::ssize(what) &&
           *text.end() == '\0';
}

} // namespace

TEST(file_text_ends_with_a_zero) {
    CHECK(says({}, ""));
    CHECK(says("", ""));
    CHECK(says("abc", "abc"));
    const std::string withZero("a\0b", 3);
    CHECK(says(withZero, withZero));
    CHECK(FileText("abc").starts_with("ab") && !FileText("abc").starts_with("abcd"));
    FileText text;
    for (const std::size_t size : {5u, 2u, 3u, 100'000u, 0u}) {
        text.resize(size);
        std::memset(text.data(), 'x', size);
        CHECK_INFO(says(text, std::string(size, 'x')), size);
    }
}

TEST(file_text_is_there_once_it_has_moved) {
    FileText a("first"), b = a, c = std::move(a);
    CHECK(says(b, "first") && says(c, "first"));
    // A text that has moved is an empty one: NOLINTNEXTLINE(bugprone-use-after-move)
    CHECK(says(a, ""));
    a = c;
    c = std::move(b);
    CHECK(says(a, "first") && says(c, "first"));
    c = {};
    CHECK(says(c, ""));
}

} // namespace test_file_text
