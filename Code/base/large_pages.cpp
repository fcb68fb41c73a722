#include "base/large_pages.h"

#include <cstdint>
#include <cstdlib>
#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
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

void startLargeHeap() {
#if defined(__GLIBC__)
    constexpr int kHeap = 64 << 20, kUsualPad = 128 << 10;
    mallopt(M_MMAP_THRESHOLD, 4 << 20); // arrays of many pages stay outside and go back at once
    mallopt(M_TRIM_THRESHOLD, 2 * kHeap);
    mallopt(M_TOP_PAD, kHeap);
    void* const first = std::malloc(kUsualPad + 1); // more than is there: the heap grows
    adviseLargePages(first, kHeap);
    std::free(first);
    mallopt(M_TOP_PAD, kUsualPad);
#endif
}
