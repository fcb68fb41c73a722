// Large arrays, and what a thread allocates but for the start of its first piece, lie in large
// pages as long as none of these was dear, where malloc is glibc's.
#include "base/large_pages.h"
#include "base/pages.h"
#include "base/zeroed.h"
#include "check.h"

// Sanitizers have a malloc of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HAS_OTHER_MALLOC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HAS_OTHER_MALLOC
#endif
#endif

#if defined(__GLIBC__) && !defined(HAS_OTHER_MALLOC)

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace test_large_pages {

namespace {

// "... hg ..." of the mapping that an address lies in; empty where the system does not tell.
std::string flagsOf(std::uintptr_t address) {
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
}

} // namespace

// By both ways to large arrays. The first page is tried, and those behind it stay as they were if
// that was dear: nobody can tell here, so this is a test of either.
TEST(large_pages_in_arrays) {
    foreseeMemory(kWorthATrial);
    constexpr std::size_t kBytes = 9 * kLargePage;
    const auto flagsInside = [](const void* array) {
        return flagsOf(reinterpret_cast<std::uintptr_t>(array) + kBytes / 2);
    };
    // What is known of pages when an array has them: the next one may find them dear.
    const ZeroedVector<char> zeroed(kBytes);
    const bool wereDear = largePagesAreDear();
    const PageVector<char> pages(kBytes);
    const bool areDear = largePagesAreDear();
    const std::string first = flagsInside(zeroed.data()), second = flagsInside(pages.data());
    CHECK_EQUAL(std::count(zeroed.begin(), zeroed.end(), 0), std::ptrdiff_t{kBytes});
    if (first.empty()) return; // the system does not tell
    CHECK_INFO(wereDear != (first.find(" hg ") != std::string::npos), wereDear << first);
    // The memory of this one may be that of another, from before it was known.
    CHECK_INFO(areDear || second.find(" hg ") != std::string::npos, second);
}

// Where little will be written, only arrays are worth it that alone are: a page that is dear takes
// as long as all small ones together.
TEST(large_pages_are_for_much_memory) {
    const auto flagsIn = [](std::size_t bytes) { // of a mapping of its own
        const ZeroedVector<char> array(bytes);
        return flagsOf(reinterpret_cast<std::uintptr_t>(array.data()) + bytes / 2);
    };
    constexpr std::size_t kLittle = kWorthATrial - kLargePage, kMuch = kWorthATrial + kLargePage;
    foreseeMemory(kWorthATrial - 1);
    const std::string little = flagsIn(kLittle), much = flagsIn(kMuch);
    if (little.empty()) return; // the system does not tell
    CHECK_INFO(little.find(" hg ") == std::string::npos, little);
    CHECK_INFO(largePagesAreDear() || much.find(" hg ") != std::string::npos, much);
    foreseeMemory(kWorthATrial);
    const std::string again = flagsIn(kLittle);
    CHECK_INFO(largePagesAreDear() || again.find(" hg ") != std::string::npos, again);
}

// Threads get heaps that others have left, first: one of many that live at a time has a new one.
TEST(large_pages_in_threads) {
    foreseeMemory(kWorthATrial);
    useLargePages(1 << 20, 0, true);
    constexpr int kMost = 128;
    std::atomic<bool> done{false}, advised{false}, known{true};
    std::atomic<int> looked{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < kMost && !advised && known; ++i) {
        threads.emplace_back([&] {
            useLargePagesInThread();
            constexpr std::size_t kSize = 50000; // more than what is left of the small pages
            const auto piece = std::make_unique<char[]>(kSize);
            const std::string flags =
                flagsOf(reinterpret_cast<std::uintptr_t>(piece.get()) + kSize - 1);
            if (flags.empty()) known = false;
            if (flags.find(" hg ") != std::string::npos) advised = true;
            ++looked;
            looked.notify_one();
            done.wait(false);
        });
        looked.wait(i);
    }
    done = true;
    done.notify_all();
    for (std::thread& thread : threads) thread.join();
    CHECK_INFO(advised || !known || largePagesAreDear(),
               "none of " << threads.size() << " threads");
}

} // namespace test_large_pages

#endif
