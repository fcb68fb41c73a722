#include "base/large_pages.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#include <unistd.h>
#endif

void adviseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21;
    const auto start = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t inside = (kPage - start % kPage) % kPage;
    if (bytes < inside + kPage) return;
    madvise(static_cast<char*>(memory) + inside, (bytes - inside) / kPage * kPage, MADV_HUGEPAGE);
#endif
}

namespace {

[[maybe_unused]] void* filler = nullptr; // of the heap; tools that look for leaks find it here

// What is smaller comes from malloc. calloc would write the zeros of larger things, too, where the
// heap has grown ahead of them.
[[maybe_unused]] constexpr std::size_t kOwnPages = std::size_t{1} << 21;

#if defined(__linux__)

constexpr std::size_t kPage = std::size_t{1} << 21;
// The last page is a large one if so much of it is needed: it costs as much as some 60 small ones.
constexpr std::size_t kWorthAPage = std::size_t{1} << 18;

std::size_t inPages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

// From the start of a page on, so that none is lost at the ends.
void* mapPages(std::size_t bytes) {
    const std::size_t size = inPages(bytes);
    if (size < bytes || size + kPage < size) return nullptr;
    void* const memory =
        mmap(nullptr, size + kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return nullptr;
    char* const all = static_cast<char*>(memory);
    const std::size_t before = kPage - reinterpret_cast<std::uintptr_t>(memory) % kPage;
    munmap(all, before);
    if (before < kPage) munmap(all + before + size, kPage - before);
    madvise(all + before, (bytes + kPage - kWorthAPage) / kPage * kPage, MADV_HUGEPAGE);
    return all + before;
}

#endif

} // namespace

void* zeroedMemory(std::size_t bytes) {
#if defined(__linux__)
    if (bytes >= kOwnPages) return mapPages(bytes);
#endif
    return std::calloc(1, std::max<std::size_t>(1, bytes));
}

void freeZeroedMemory(void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    if (bytes >= kOwnPages) {
        munmap(memory, inPages(bytes));
        return;
    }
#endif
    std::free(memory);
}

void useLargePages([[maybe_unused]] std::size_t bytes) {
#if defined(__GLIBC__)
    // The heap is to grow at once by what is asked for, which the first piece makes it do. As long
    // as that lasts, arrays come from there, too; later only those of less than 4 MB.
    constexpr std::size_t kPiece = std::size_t{1} << 20, kMost = std::size_t{1} << 30;
    constexpr int kPad = 1 << 20, kLargestArray = 1 << 22;
    const std::size_t room = std::min(bytes, kMost);
    if (mallopt(M_MMAP_THRESHOLD, kLargestArray) == 0 ||
        mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max()) == 0 ||
        mallopt(M_TOP_PAD, static_cast<int>(room)) == 0)
        return;
    void* const first = std::malloc(kPiece);
    const auto start = reinterpret_cast<std::uintptr_t>(first),
               end = reinterpret_cast<std::uintptr_t>(sbrk(0));
    // Tools that watch the memory have a malloc of their own, elsewhere.
    const bool isHeap = first && start < end && end - start <= room + 2 * kPiece;
    if (isHeap) adviseLargePages(first, end - start);
    std::free(first);
    // The heap begins somewhere in a page: what is in front of the first whole one is left out.
    constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21;
    if (isHeap && room > 2 * kPage) filler = std::malloc((kPage - start % kPage) % kPage);
    mallopt(M_TOP_PAD, kPad);
#endif
}
