// The interface of this folder by nothing but the C++ standard library: make PLATFORM=portable.
#include "base/platform/platform.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <thread>

// ---- files

// Only to open a file tells. In a folder that is a new one, which goes again.
std::string whyNotWritable(const std::string& name) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(name, ignored);
    const bool isFolder = std::filesystem::is_directory(status);
    // To open a pipe would wait for its reader.
    if (std::filesystem::exists(status) && !isFolder && !std::filesystem::is_regular_file(status))
        return "";
    const std::string opened =
        isFolder ? name + "/" + std::to_string(processNumber()) + ".tmp" : name;
    std::FILE* const file = std::fopen(opened.c_str(), isFolder ? "wbx" : "r+b");
    if (!file) return std::strerror(errno);
    static_cast<void>(std::fclose(file));
    if (isFolder) static_cast<void>(std::remove(opened.c_str()));
    return "";
}

std::size_t readAt(std::FILE*, std::uint64_t, std::span<char>) { return 0; }

unsigned long processNumber() {
    static const unsigned long number = std::random_device()();
    return number;
}

// ---- memory

void preferLargePages(void*, std::size_t) {}

std::uint64_t peakBytes() { return 0; }

// ---- threads

int processorCount() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

// ---- terminal

Terminal terminalOfStderr() { return {}; }

// ---- signals

namespace {

std::atomic<void (*)()> onEndRequest = nullptr;
static_assert(std::atomic<void (*)()>::is_always_lock_free);

void onSignal(int signal) {
    static_cast<void>(std::signal(signal, onSignal)); // some systems forget it
    onEndRequest.load()();
}

} // namespace

void handleEndRequests(void (*onRequest)()) {
    onEndRequest = onRequest;
    for (const int signal : {SIGINT, SIGTERM})
        if (std::signal(signal, onSignal) == SIG_IGN)
            static_cast<void>(std::signal(signal, SIG_IGN));
}

// The standard allows std::_Exit() in a signal handler. std::remove() is a call of the system in
// all libraries that are known, and stderr has no buffer.
void endProgram(const char* fileToRemove, std::string_view text, int exitCode) {
    if (fileToRemove) static_cast<void>(std::remove(fileToRemove));
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
    std::_Exit(exitCode);
}
