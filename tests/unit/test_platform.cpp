// What Code/base/platform promises, of either implementation: a portable one has not all of it.
#include "base/error.h"
#include "base/file_text.h"
#include "base/platform/platform.h"
#include "base/raw_vector.h"
#include "check.h"
#include "temporary_folder.h"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <memory>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace test_platform {

namespace {

namespace fs = std::filesystem;

// The exit code of a process that calls body(), its stderr in a file; 128 and its number for a
// signal.
template <class Body> int codeOf(const std::string& errors, const Body& body) {
    const pid_t child = fork();
    if (child == 0) {
        const int file = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(file, STDERR_FILENO);
        body();
        _exit(99);
    }
    int status = 0;
    CHECK_EQUAL(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool isPortable() { return peakBytes() == 0; }

const char* fileToRemove = nullptr;
void endNow() { endProgram(fileToRemove, "\nended\n", 42); }

std::atomic<int> requests = 0;
void countRequest() { ++requests; }

std::string textOf(const std::string& file) {
    return std::string(std::string_view(readWholeText(file)));
}

} // namespace

// As it turns out when the file is opened.
TEST(platform_files_that_can_be_written) {
    const TemporaryFolder folder("writable");
    const std::string file = folder.write("file", "content");
    CHECK_EQUAL(whyNotWritable(file), "");
    CHECK_EQUAL(whyNotWritable(folder / ""), "");
    CHECK_EQUAL(whyNotWritable(folder / "none"), "No such file or directory");
    CHECK_EQUAL(whyNotWritable("/dev/null"), "");
    fs::permissions(file, fs::perms::owner_read);
    const bool canOpen = std::ofstream(file, std::ios::app).is_open();
    CHECK_EQUAL(whyNotWritable(file), canOpen ? "" : "Permission denied");
    fs::create_directory(folder / "shut");
    fs::permissions(folder / "shut", fs::perms::owner_read | fs::perms::owner_exec);
    const bool canCreate = std::ofstream(folder / "shut/new").is_open();
    CHECK_EQUAL(whyNotWritable(folder / "shut"), canCreate ? "" : "Permission denied");
    CHECK_EQUAL(textOf(file), "content");
    CHECK_EQUAL(folder.files(), 2); // nothing is left behind
    fs::permissions(folder / "shut", fs::perms::owner_all);
}

TEST(platform_reads_parts_of_a_file) {
    const TemporaryFolder folder("parts");
    std::string text(300000, ' ');
    for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * i >> 5);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        std::fopen(folder.write("file", text).c_str(), "rb"), std::fclose);
    char part[1000];
    CHECK_EQUAL(readAt(file.get(), 0, part) == 0, isPortable());
    if (isPortable()) return;
    const auto has = [&](std::size_t first, std::size_t count) {
        char bytes[1000];
        return readAt(file.get(), first, bytes) == count &&
               (count == 0 || std::string_view(bytes, count) == text.substr(first, count));
    };
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (std::size_t number = 0; number < 3; ++number)
        threads.emplace_back([&, number] {
            for (std::size_t at = number; at < 290000; at += 3001) wrong += !has(at, 1000);
        });
    for (std::thread& thread : threads) thread.join();
    CHECK_EQUAL(wrong.load(), 0);
    CHECK(has(299500, 500) && has(300000, 0) && has(400000, 0));
}

// By the same name two programs would write the same temporary file.
TEST(platform_processes_have_numbers) {
    const TemporaryFolder folder("numbers");
    CHECK_EQUAL(processNumber(), processNumber());
    const std::string name = folder / "number";
    codeOf(folder / "errors", [&] { std::ofstream(name) << processNumber() << std::flush; });
    // A portable program draws its number, before it is two processes.
    CHECK_EQUAL(textOf(name) == cat(processNumber()), isPortable());
}

TEST(platform_memory_in_large_pages_stays_as_it_is) {
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{1} << 21, std::size_t{9} << 21}) {
        std::vector<char> memory(bytes, 'x');
        preferLargePages(memory.data(), bytes);
        CHECK_EQUAL(std::count(memory.begin(), memory.end(), 'x'),
                    static_cast<std::ptrdiff_t>(bytes));
    }
}

// The system tells of each mapping whether it is to have large pages: " hg ".
TEST(platform_large_arrays_get_large_pages) {
    const auto flagsOf = [](const void* at) -> std::string {
        const auto address = reinterpret_cast<std::uintptr_t>(at);
        std::ifstream maps("/proc/self/smaps");
        std::string line;
        for (bool isHere = false; std::getline(maps, line);) {
            const std::size_t dash = line.find('-'), blank = line.find(' ');
            if (dash < blank && blank != std::string::npos)
                isHere = std::stoull(line, nullptr, 16) <= address &&
                         address < std::stoull(line.substr(dash + 1), nullptr, 16);
            else if (isHere && line.starts_with("VmFlags:"))
                return line + " ";
        }
        return "";
    };
    if (isPortable()) return;
    const RawVector<char> raw(std::size_t{9} << 21);
    const ZeroedVector<char> zeroed(std::size_t{9} << 21);
    for (const std::string& flags : {flagsOf(&raw[9 << 20]), flagsOf(&zeroed[9 << 20])})
        CHECK_INFO(flags.empty() || flags.find(" hg ") != std::string::npos, flags);
}

TEST(platform_peak_memory_grows) {
    if (isPortable()) return;
    const std::uint64_t before = peakBytes();
    CHECK(before > 100'000);
    const std::vector<char> much(before + (64 << 20), 'x');
    CHECK(peakBytes() > much.size());
}

TEST(platform_processors_of_this_program) {
    CHECK(processorCount() >= 1);
    if (isPortable()) return;
    const TemporaryFolder folder("processors");
    const int code = codeOf(folder / "errors", [] {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(sched_getcpu(), &one);
        _exit(sched_setaffinity(0, sizeof one, &one) == 0 ? processorCount() : 98);
    });
    CHECK_EQUAL(code, 1);
}

TEST(platform_no_terminal_has_the_usual_size) {
    const TemporaryFolder folder("terminal");
    const int code = codeOf(folder / "errors", [] {
        const Terminal terminal = terminalOfStderr();
        _exit(!terminal.present && terminal.columns == 80 && terminal.rows == 24 ? 7 : 8);
    });
    CHECK_EQUAL(code, 7);
}

TEST(platform_terminal_tells_its_size) {
    const TemporaryFolder folder("terminal");
    const int code = codeOf(folder / "errors", [] {
        const int master = posix_openpt(O_RDWR | O_NOCTTY);
        if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) _exit(6);
        const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
        const winsize size{.ws_row = 33, .ws_col = 101, .ws_xpixel = 0, .ws_ypixel = 0};
        if (terminal < 0 || ioctl(terminal, TIOCSWINSZ, &size) != 0) _exit(6);
        dup2(terminal, STDERR_FILENO);
        const Terminal found = terminalOfStderr();
        if (!found.present) _exit(6);
        _exit(found.columns == 101 && found.rows == 33 ? 7 : 8);
    });
    CHECK_INFO(code == 7 || code == 6, code); // 6: none can be made here, or none is ever known
}

TEST(platform_requests_to_end_the_program) {
    const TemporaryFolder folder("signals");
    for (const int signal : {SIGINT, SIGTERM}) {
        const std::string file = folder.write("temporary", "half");
        fileToRemove = file.c_str();
        const int code = codeOf(folder / "errors", [&] {
            static_cast<void>(std::signal(signal, SIG_DFL));
            handleEndRequests(endNow);
            static_cast<void>(std::raise(signal));
        });
        CHECK_EQUAL(code, 42);
        CHECK(!fs::exists(file));
        CHECK_EQUAL(textOf(folder / "errors"), "\nended\n");
    }
    fileToRemove = nullptr;
    // As often as it is asked, and not where that was ignored before.
    const int code = codeOf(folder / "errors", [] {
        std::signal(SIGINT, SIG_DFL), std::signal(SIGTERM, SIG_IGN);
        handleEndRequests(countRequest);
        for (int i = 0; i < 3; ++i) raise(SIGINT), raise(SIGTERM);
        _exit(requests);
    });
    CHECK_EQUAL(code, 3);
}

TEST(platform_writing_into_a_closed_pipe_fails) {
    if (isPortable()) return;
    const TemporaryFolder folder("pipe");
    const int code = codeOf(folder / "errors", [] {
        static_cast<void>(std::signal(SIGPIPE, SIG_DFL));
        handleEndRequests(countRequest);
        int ends[2];
        if (pipe(ends) != 0) _exit(6);
        close(ends[0]);
        _exit(write(ends[1], "x", 1) == -1 ? 7 : 8);
    });
    CHECK_EQUAL(code, 7);
}

} // namespace test_platform
