#include "base/heap.h"

#include "base/large_pages.h"

#if defined(__GLIBC__)
#include <cstdlib>
#include <malloc.h>
#include <unistd.h>
#endif

void growHeapInLargeSteps() {
#if defined(__GLIBC__)
    // Of addresses and not yet of memory. More of them would keep the large arrays of large scenes
    // as well, and so the holes that they leave: those are better given back.
    constexpr int kStep = 24 << 20, kLater = 128 << 10;
    constexpr std::size_t kMoreThanIsLeft = 256 << 10;
    // Arrays below 4 MB are cut from the heap as long as it lasts and are not given back: the next
    // ones find pages that have been touched.
    mallopt(M_MMAP_THRESHOLD, 4 << 20);
    mallopt(M_TRIM_THRESHOLD, 4 * kStep);
    mallopt(M_TOP_PAD, kStep);
    const char* const before = static_cast<const char*>(sbrk(0));
    void* volatile some = std::malloc(kMoreThanIsLeft); // volatile: compilers leave out such pairs
    std::free(some);
    char* const after = static_cast<char*>(sbrk(0));
    mallopt(M_TOP_PAD, kLater); // where addresses are scarce, small steps go farther
    if (after - before >= kStep) adviseLargePages(after - kStep, kStep);
#endif
}
