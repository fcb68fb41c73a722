#include "base/find_pages.h"

#include "base/for_each.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <system_error>
#include <thread>
#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <unistd.h>
#endif

namespace {

// False where the system does not know how, as before Linux 5.14; then the first touch does it.
bool findPart([[maybe_unused]] std::uintptr_t first, [[maybe_unused]] std::uintptr_t last) {
#if defined(MADV_POPULATE_WRITE)
    return madvise(reinterpret_cast<void*>(first), last - first, MADV_POPULATE_WRITE) == 0;
#else
    return false;
#endif
}

} // namespace

void findPages(void* memory, std::size_t bytes, int threads) {
    constexpr std::uintptr_t kSmallPage = 1 << 12; // or more: then it is not done
    constexpr std::size_t kTogether = std::size_t{1} << 19;
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = (start + kSmallPage - 1) / kSmallPage * kSmallPage,
                         last = (start + bytes) / kSmallPage * kSmallPage;
    if (first >= last) return;
    forEachPart(threads, last - first, kTogether, [&](std::size_t from, std::size_t to) {
        static_cast<void>(findPart(first + from, first + to));
    });
}

void findRoomAhead([[maybe_unused]] std::size_t bytes) {
#if defined(__GLIBC__)
    constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21, kPiece = kPage / 2;
    static std::jthread finder; // the program's end waits for it
    if (finder.joinable()) return;
    // What is too large for a hole comes from the end of what is used. Tools that watch the memory
    // have a malloc of their own, elsewhere.
    const std::unique_ptr<void, decltype(&std::free)> here(std::malloc(kPiece), &std::free);
    const auto start = reinterpret_cast<std::uintptr_t>(here.get()),
               heapEnd = reinterpret_cast<std::uintptr_t>(sbrk(0));
    if (!here || start >= heapEnd) return;
    const std::uintptr_t first = (start + kPage - 1) / kPage * kPage;
    const std::uintptr_t last = std::min(start + bytes, heapEnd) / kPage * kPage;
    if (first >= last) return;
    try {
        finder = std::jthread([first, last] {
            for (std::uintptr_t page = first; page < last; page += kPage)
                if (!findPart(page, page + kPage)) return;
        });
    } catch (const std::system_error&) {
        // No more threads: whoever touches the memory finds it.
    }
#endif
}
