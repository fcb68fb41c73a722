// What a thread allocates lies in large pages, but for the start of its first piece, where malloc
// is glibc's.
#include "base/large_pages.h"
#include "check.h"

#if defined(__GLIBC__)

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

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

TEST(large_pages_in_threads) {
    useLargePages(1 << 20, true);
    std::thread([] {
        useLargePagesInThread();
        constexpr std::size_t kSize = 50000, kHeap = std::size_t{1} << 26, kPage = 1 << 21;
        const auto piece = std::make_unique<char[]>(kSize);
        const auto address = reinterpret_cast<std::uintptr_t>(piece.get());
        const std::string flags = flagsOf(address + kSize - 1);
        if (flags.empty() || address % kHeap > 4 * kPage) return; // the malloc of a sanitizer
        CHECK_INFO(flags.find(" hg ") != std::string::npos, flags);
        // No more than the end of a page of small ones comes before.
        CHECK_INFO(address % kHeap + kSize >= kPage, address % kHeap);
    }).join();
}

#endif
