#include "check.h"

#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>

namespace check {

namespace {
int failuresOfTest = 0;
}

std::vector<Test>& tests() {
    static std::vector<Test> all;
    return all;
}

void failed(const char* file, int line, const std::string& message) {
    constexpr int kPrinted = 20;
    if (++failuresOfTest <= kPrinted) std::printf("%s:%d: %s\n", file, line, message.c_str());
}

int stress() {
    static const int factor = [] {
        const char* text = std::getenv("STRESS");
        if (!text) return 1;
        int value = 0;
        const char* end = text + std::strlen(text);
        const auto [stop, error] = std::from_chars(text, end, value);
        if (error != std::errc() || stop != end || value < 1 || value > 1000)
            throw std::runtime_error(std::string("STRESS is '") + text +
                                     "'; a whole number from 1 to 1000 is needed");
        return value;
    }();
    return factor;
}

std::string thrown(const std::function<void()>& body) {
    try {
        body();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

} // namespace check

// Arguments: words; a test runs when its name contains one of them (all without arguments).
// --list prints the names, --times prints the seconds of each test. STRESS=n in the environment
// makes the random tests n times as long.
int main(int argc, char** argv) {
    bool list = false, times = false, chosen = false;
    for (int i = 1; i < argc; ++i) {
        if (!std::strcmp(argv[i], "--list"))
            list = true;
        else if (!std::strcmp(argv[i], "--times"))
            times = true;
        else
            chosen = true;
    }
    try {
        check::stress();
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "%s\n", error.what()));
        return 2;
    }
    int passedCount = 0, failedCount = 0;
    for (const check::Test& test : check::tests()) {
        bool wanted = !chosen;
        for (int i = 1; i < argc; ++i) wanted = wanted || std::strstr(test.name, argv[i]);
        if (!wanted) continue;
        if (list) {
            std::puts(test.name);
            continue;
        }
        check::failuresOfTest = 0;
        const auto start = std::chrono::steady_clock::now();
        try {
            test.run();
        } catch (const std::exception& error) {
            check::failed(test.name, 0, std::string("threw: ") + error.what());
        }
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        if (times) std::printf("%8.3f s  %s\n", seconds.count(), test.name);
        if (check::failuresOfTest == 0)
            ++passedCount;
        else {
            ++failedCount;
            std::printf("FAIL %s (%d checks)\n", test.name, check::failuresOfTest);
        }
    }
    if (!list) std::printf("%d passed, %d failed\n", passedCount, failedCount);
    return failedCount == 0 ? 0 : 1;
}
