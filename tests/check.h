// The test kit: TEST(name) { CHECK(...); CHECK_NEAR(value, expected, tolerance); }.
// A failed check prints file, line and both values; the test goes on, so that all failures show.
// tests/main.cpp runs every test, or those whose name contains a word given on the command line.
#pragma once

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace check {

struct Test {
    const char* name;
    void (*run)();
};
std::vector<Test>& tests();
struct Register {
    Register(const char* name, void (*run)()) { tests().push_back({name, run}); }
};
// Counts a failure of the running test and prints it (the first 20 of a test, then only counts).
void failed(const char* file, int line, const std::string& message);

template <class T> std::string shown(const T& value) {
    std::ostringstream out;
    out.precision(17);
    if constexpr (requires { out << value; })
        out << value;
    else
        out << "(value)";
    return out.str();
}
// The environment variable STRESS, a whole number from 1 to 1000; 1 when it is not set. Throws for
// anything else.
int stress();
// How many random cases a test has: `count`, or with STRESS=n n times as many.
template <class Count> Count scaled(Count count) { return count * static_cast<Count>(stress()); }
// Runs the body, and returns the message of the exception it throws, or "" when it throws none.
std::string thrown(const std::function<void()>& body);

} // namespace check

#define TEST(name)                                                                                 \
    static void test_##name();                                                                     \
    static const check::Register register_##name(#name, test_##name);                              \
    static void test_##name()
#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) check::failed(__FILE__, __LINE__, #condition);                           \
    } while (false)
// Like CHECK, and prints `info` (anything that can be streamed: the failing case, the seed).
#define CHECK_INFO(condition, info)                                                                \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            std::ostringstream text_;                                                              \
            text_.precision(9);                                                                    \
            text_ << #condition << "; " << info; /* NOLINT(bugprone-macro-parentheses): a << b */  \
            check::failed(__FILE__, __LINE__, text_.str());                                        \
        }                                                                                          \
    } while (false)
#define CHECK_EQUAL(value, expected)                                                               \
    do {                                                                                           \
        const auto& value_ = (value);                                                              \
        const auto& expected_ = (expected);                                                        \
        if (!(value_ == expected_))                                                                \
            check::failed(__FILE__, __LINE__,                                                      \
                          std::string(#value " is ") + check::shown(value_) + ", expected " +      \
                              check::shown(expected_));                                            \
    } while (false)
#define CHECK_NEAR(value, expected, tolerance)                                                     \
    do {                                                                                           \
        const double value_ = static_cast<double>(value);                                          \
        const double expected_ = static_cast<double>(expected);                                    \
        const double tolerance_ = static_cast<double>(tolerance);                                  \
        if (!(std::fabs(value_ - expected_) <= tolerance_))                                        \
            check::failed(__FILE__, __LINE__,                                                      \
                          std::string(#value " is ") + check::shown(value_) + ", expected " +      \
                              check::shown(expected_) + " +- " + check::shown(tolerance_));        \
    } while (false)
// The body must throw, and its message must contain the words.
#define CHECK_THROWS(body, words)                                                                  \
    do {                                                                                           \
        const std::string message_ = check::thrown([&] { body; });                                 \
        if (message_.find(words) == std::string::npos)                                             \
            check::failed(__FILE__, __LINE__,                                                      \
                          "expected an error with '" + std::string(words) + "', got '" +           \
                              message_ + "'");                                                     \
    } while (false)
