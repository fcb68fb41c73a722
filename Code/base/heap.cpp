#include "base/heap.h"

#include "base/pages.h"

#include <cstdint>
#include <cstdlib> // also says __GLIBC__

#if defined(__linux__) && defined(__GLIBC__)
#include <malloc.h>
#include <unistd.h>

void prepareHeap() {
    constexpr int kBytes = 32 << 20; // as large as glibc lets the threshold be
    if (mallopt(M_MMAP_THRESHOLD, kBytes) == 0 || mallopt(M_TOP_PAD, kBytes) == 0 ||
        mallopt(M_TRIM_THRESHOLD, 2 * kBytes) == 0)
        return;
    // More than has been freed so far makes the heap grow; by the padding it is said how far.
    constexpr std::size_t kMore = std::size_t{1} << 18;
    const auto end = [] { return reinterpret_cast<std::uintptr_t>(sbrk(0)); };
    const std::uintptr_t first = (end() + kLargePage - 1) / kLargePage * kLargePage;
    void* volatile some = std::malloc(kMore); // volatile: or the pair is left out
    std::free(some);
    if (const std::uintptr_t last = end() / kLargePage * kLargePage; first < last)
        madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE); // works without
}
#else
void prepareHeap() {}
#endif
