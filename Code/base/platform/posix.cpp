// The interface of this folder by the calls of POSIX, and where Linux has more, by those.
#include "base/platform/platform.h"
#include "base/processor_quota.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#if defined(__linux__)
#include <sched.h>
#endif

// ---- files

std::string whyNotWritable(const std::string& name) {
    return access(name.c_str(), W_OK) == 0 ? "" : std::strerror(errno);
}

std::size_t readAt(std::FILE* file, std::uint64_t first, std::span<char> to) {
    const ssize_t count = pread(fileno(file), to.data(), to.size(), static_cast<off_t>(first));
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

unsigned long processNumber() { return static_cast<unsigned long>(getpid()); }

// ---- memory

void preferLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
    constexpr std::size_t kPage = std::size_t{1} << 21;
    const std::size_t before = (kPage - reinterpret_cast<std::uintptr_t>(memory) % kPage) % kPage;
    if (bytes < before + kPage) return;
    // Where it fails, pages are small.
    static_cast<void>(madvise(static_cast<char*>(memory) + before, (bytes - before) / kPage * kPage,
                              MADV_HUGEPAGE));
#endif
}

std::uint64_t peakBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    constexpr std::uint64_t kUnit = 1; // macOS counts bytes, Linux and BSD kibibytes
#else
    constexpr std::uint64_t kUnit = 1024;
#endif
    return static_cast<std::uint64_t>(usage.ru_maxrss) * kUnit;
}

// ---- threads

#if defined(__linux__)
namespace {

std::string firstLine(const std::string& name) {
    char line[256] = "";
    if (std::FILE* const file = std::fopen(name.c_str(), "r")) {
        if (std::fgets(line, sizeof line, file) == nullptr) line[0] = 0;
        static_cast<void>(std::fclose(file));
    }
    std::string text = line;
    if (text.ends_with('\n')) text.pop_back();
    return text;
}

// The smallest quota of this program's control group and of those around it; 0 without any.
int quotaOfGroups() {
    const std::string root = "/sys/fs/cgroup";
    int least = 0;
    const auto take = [&](int count) {
        if (count > 0 && (least == 0 || count < least)) least = count;
    };
    std::string group = firstLine("/proc/self/cgroup"); // "0::/a/b" of version 2
    group = group.starts_with("0::/") ? group.substr(3) : "/";
    for (; group.size() > 1; group.resize(std::max<std::size_t>(group.rfind('/'), 1)))
        take(processorsOfQuota(firstLine(root + group + "/cpu.max")));
    take(processorsOfQuota(firstLine(root + "/cpu.max")));
    take(processorsOfQuota(firstLine(root + "/cpu/cpu.cfs_quota_us") + " " +
                           firstLine(root + "/cpu/cpu.cfs_period_us"))); // version 1
    return least;
}

} // namespace
#endif

int processorCount() {
    int count = static_cast<int>(std::thread::hardware_concurrency());
#if defined(__linux__)
    // Containers and taskset leave a program some of the machine's processors.
    cpu_set_t mine;
    CPU_ZERO(&mine);
    if (sched_getaffinity(0, sizeof mine, &mine) == 0) count = CPU_COUNT(&mine);
    if (const int quota = quotaOfGroups(); quota > 0) count = std::min(count, quota);
#endif
    return std::max(1, count);
}

// ---- terminal

Terminal terminalOfStderr() {
    Terminal terminal;
    terminal.present = isatty(STDERR_FILENO) == 1;
    winsize size{};
    if (terminal.present && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 &&
        size.ws_row > 0) {
        terminal.columns = size.ws_col;
        terminal.rows = size.ws_row;
    }
    return terminal;
}

// ---- signals

namespace {

std::atomic<void (*)()> onEndRequest = nullptr;
static_assert(std::atomic<void (*)()>::is_always_lock_free);

} // namespace

void handleEndRequests(void (*onRequest)()) {
    onEndRequest = onRequest;
    struct sigaction action {};
    action.sa_handler = [](int) { onEndRequest.load()(); };
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        sigaction(signal, &action, nullptr);
    }
    for (const int signal : {SIGPIPE, SIGXFSZ}) static_cast<void>(std::signal(signal, SIG_IGN));
}

// By what POSIX allows in a signal handler: unlink(), write(), _exit().
void endProgram(const char* fileToRemove, std::string_view text, int exitCode) {
    if (fileToRemove) unlink(fileToRemove);
    // Nothing can be done about a message that does not arrive.
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
    _exit(exitCode);
}
