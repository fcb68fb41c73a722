#include "check.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace check {

namespace {

int failuresOfTest = 0;

constexpr int kMost = 1000; // of processes, and of STRESS

// A whole number from 1 to kMost that is all of the text, or 0.
int countIn(const char* text) {
    int value = 0;
    const char* end = text + std::strlen(text);
    const auto [stop, error] = std::from_chars(text, end, value);
    return error == std::errc() && stop == end && value >= 1 && value <= kMost ? value : 0;
}

} // namespace

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
        const int value = countIn(text);
        if (value == 0)
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

namespace {

// What the processes that run the tests share: each takes the next test, so that none waits long.
struct Shared {
    std::atomic<std::size_t> next = 0;
    std::atomic<int> passed = 0, failed = 0;
    std::atomic<std::size_t> at[check::kMost] = {}; // which test each process is at
};

void runTests(const std::vector<check::Test>& tests, bool times, Shared& shared, int job = 0) {
    for (std::size_t i = shared.next++; i < tests.size(); i = shared.next++) {
        const check::Test& test = tests[i];
        shared.at[job] = i;
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
            ++shared.passed;
        else {
            ++shared.failed;
            std::printf("FAIL %s (%d checks)\n", test.name, check::failuresOfTest);
        }
        static_cast<void>(std::fflush(stdout)); // what a test says stays together
    }
    shared.at[job] = tests.size();
}

// Says which test a process was at when it ended with this status of wait(), and how.
void printEnd(const std::vector<check::Test>& tests, std::size_t at, int status) {
    std::printf("FAIL %s: %s %d ended the process that ran it\n",
                at < tests.size() ? tests[at].name : "after the last test",
                WIFSIGNALED(status) ? "signal" : "exit status",
                WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
}

// Runs the tests in so many processes of their own; false when one of them did not come to its end.
// Processes and not threads: a test may change what all threads have, such as the kernel or a limit
// of the system.
bool runTestsInProcesses(const std::vector<check::Test>& tests, bool times, int jobs,
                         Shared& shared) {
    std::vector<pid_t> children;
    for (int job = 0; job < jobs; ++job) {
        const pid_t child = fork();
        if (child < 0) break;
        if (child > 0) {
            children.push_back(child);
            continue;
        }
        runTests(tests, times, shared, job);
        std::exit(0); // not _exit: a sanitizer looks for leaks there
    }
    bool sound = static_cast<int>(children.size()) == jobs;
    for (std::size_t job = 0; job < children.size(); ++job) {
        int status = 0;
        if (waitpid(children[job], &status, 0) > 0 && status == 0) continue;
        sound = false;
        printEnd(tests, shared.at[job], status);
    }
    return sound;
}

} // namespace

// Arguments: words; a test runs when its name contains one of them (all without arguments).
// --list prints the names, --times prints the seconds of each test, --jobs=N runs them in N
// processes. STRESS=n in the environment makes the random tests n times as long.
int main(int argc, char** argv) {
    bool list = false, times = false;
    int jobs = 1;
    std::vector<const char*> words;
    for (int i = 1; i < argc; ++i) {
        if (!std::strcmp(argv[i], "--list"))
            list = true;
        else if (!std::strcmp(argv[i], "--times"))
            times = true;
        else if (!std::strncmp(argv[i], "--jobs=", 7))
            jobs = check::countIn(argv[i] + 7);
        else
            words.push_back(argv[i]);
    }
    if (jobs == 0) {
        static_cast<void>(std::fprintf(stderr, "--jobs= needs a whole number from 1 to 1000\n"));
        return 2;
    }
    try {
        check::stress();
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "%s\n", error.what()));
        return 2;
    }
    std::vector<check::Test> chosen;
    for (const check::Test& test : check::tests())
        if (words.empty() || std::any_of(words.begin(), words.end(), [&](const char* word) {
                return std::strstr(test.name, word);
            }))
            chosen.push_back(test);
    if (list) {
        for (const check::Test& test : chosen) std::puts(test.name);
        return 0;
    }
    void* room =
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) {
        static_cast<void>(
            std::fprintf(stderr, "no memory to share between the tests' processes\n"));
        return 2;
    }
    Shared& shared = *new (room) Shared;
    if (jobs == 1) {
        runTests(chosen, times, shared);
    } else if (!runTestsInProcesses(chosen, times, jobs, shared)) {
        std::printf("a process that ran tests did not come to its end\n");
        return 2;
    }
    std::printf("%d passed, %d failed\n", shared.passed.load(), shared.failed.load());
    return shared.failed == 0 ? 0 : 1;
}
